"""What a vehicle is to the simulation, and all that is needed to make one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Protocol

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from sim.backend_bullet import Bullet, State
from sim.sensors.bumper import BumperRing
from sim.shapes import Quat, Shape, Vec3
from sim.vehicles.parameters import Parameters
from sim.world import World

__all__ = ["Model", "Vehicle"]


class Vehicle(Protocol):
    """A robot in the physics, with its drive and its sensors."""

    parameters: Parameters
    body: int
    """Its number in the physics."""
    bumper: BumperRing
    """Counts its bumps."""

    def drive(self, twist: Twist) -> None:
        """Go for `twist` in `base_link` until told otherwise."""

    def stop(self) -> None:
        """Brake to rest."""

    def advance(self) -> None:
        """One physics step."""

    def state(self) -> State:
        """Where it really is and how it moves, in `map`."""

    def measure(self, stamp: float, *, truth: bool) -> Iterator[tuple[str, Msg]]:
        """Topic and message of what is due after this step, with `stamp` [s]; ground truth only with `truth`."""


class Build(Protocol):
    """Puts a vehicle into a world that already has its ground and its things."""

    def __call__(
        self, backend: Bullet, world: World, *, seed: int, noise: bool, parameters: Parameters
    ) -> Vehicle:
        """It stands still at the world's start; with `noise` False every sensor is exact."""


@dataclass(frozen=True, slots=True)
class Model:
    """One line of `sim.robot.ROBOTS`."""

    build: Build
    """The vehicle's class."""
    parameters: Parameters
    """Its numbers."""
    looks: Callable[[Parameters, Vec3, Quat], tuple[Shape, ...]]
    """The shapes to draw of one at a position [m], turned by a rotation."""
