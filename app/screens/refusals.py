"""What the robot would refuse of a draft, said while it is edited. The robot's own answer is what counts."""

from __future__ import annotations

from app.mission import Draft
from widgets.fence import Fence

__all__ = ["refused", "summary"]

NAMED = 4
"""As many points are called by their numbers."""


def refused(fence: Fence, draft: Draft, radius: float) -> dict[str, str]:
    """Name, as the robot would call it, of each point and of home that a robot of `radius` [m] would refuse, to its sentence."""
    places = [(f"Point {number}", point) for number, point in enumerate(draft.points, 1)]
    places += [("Home", draft.home)] if draft.home is not None else []
    said = {name: fence.fault(name, *place, radius) for name, place in places}
    return {name: sentence for name, sentence in said.items() if sentence}


def summary(names: list[str]) -> str:
    """One short sentence about what `refused` found; empty for nothing."""
    points = [name.removeprefix("Point ") for name in names if name != "Home"]
    words = []
    if len(points) > NAMED:
        words.append(f"{len(points)} points")
    elif points:
        words.append(f"point{'s' if len(points) > 1 else ''} {', '.join(points)}")
    if "Home" in names:
        words.append("home")
    return f"The fence forbids {' and '.join(words)}." if words else ""
