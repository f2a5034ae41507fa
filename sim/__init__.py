"""Simulated robots and the worlds they drive in, behind the same port as a real robot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sim.environment import DriveToGoal

__all__ = ["make"]


def make(
    robot: str,
    world: str = "",
    *,
    payloads: Sequence[str] = (),
    distance: tuple[float, float] = (2.0, 8.0),
    time_limit: float = 60.0,
    noise: bool = True,
    render_mode: str | None = None,
) -> DriveToGoal:
    """An environment of Gymnasium with that `robot`, for programs that train; `DriveToGoal` tells what each argument means.

    Raises ModuleNotFoundError where Gymnasium is not installed: `pip install pilothouse[sim]` brings it.
    """
    from sim.environment import DriveToGoal

    return DriveToGoal(
        robot,
        world,
        payloads=payloads,
        distance=distance,
        time_limit=time_limit,
        noise=noise,
        render_mode=render_mode,
    )
