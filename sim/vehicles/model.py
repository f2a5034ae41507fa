"""The interface of a vehicle to the simulation, and the model that makes one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, Protocol

from msgspec import structs

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from sim.core.parameters import CameraParameters
from sim.core.shapes import Shape
from sim.physics.backend_bullet import State
from sim.sensors.battery import Battery
from sim.sensors.bumper import BumperRing
from sim.sensors.suite import SensorSuite
from sim.vehicles.parameters import Parameters
from sim.vehicles.scene import Scene
from sim.world.tables import Dock
from sim.world.world import World

__all__ = ["Model", "Vehicle", "numbered", "suits"]


class Vehicle(Protocol):
    """A robot in the physics, with its drive and its sensors; `sim.vehicles.chassis` has what all share."""

    MANOEUVRES: ClassVar[tuple[str, ...]]
    """The orders that it knows."""
    scene: Scene
    """Its surroundings."""
    suite: SensorSuite
    """Its sensors."""
    battery: Battery
    """Feeds it."""
    cameras: list[CameraParameters]
    """Its cameras, the first one is the main one."""
    laser_x: float
    """Distance of its laser ahead of `base_link` [m]."""
    attached: list[Callable[[], tuple[Shape, ...]]]
    """Visible shapes of its payloads, in `base_link`."""
    body: int
    """Its number in the physics."""
    bumper: BumperRing
    """Counts its bumps."""
    dock: Dock | None
    """The dock whose contacts it touches; None when it touches none."""
    raft: int
    """Number of the raft that it stands on where there is no ground; -1 for none."""

    @property
    def parameters(self) -> Parameters:
        """Its numbers."""

    @property
    def heights(self) -> tuple[float, float]:
        """The lowest and the highest at which it can be, above the map's origin [m]."""

    def drive(self, twist: Twist) -> None:
        """Go for `twist` in `base_link` until the next order."""

    def stop(self) -> None:
        """Brake to rest."""

    def manoeuvre(self, order: Manoeuvre) -> None:
        """Move by `order` until the next order; ValueError with one sentence when it cannot."""

    def reset(self) -> None:
        """Go back to the start, at rest, and believe to be there."""

    def before_step(self) -> None:
        """Act on the body for the physics step that follows."""

    def after_step(self) -> None:
        """Update with the result of the physics step."""

    def state(self) -> State:
        """True pose and motion, in `map`."""

    @property
    def has_measurements(self) -> bool:
        """`measure` has something to give after this step; else it need not be called."""

    def measure(self, stamp: float, *, truth: bool) -> Iterator[tuple[str, Msg]]:
        """Topics and messages that are due after this step, with `stamp` [s]; ground truth only with `truth`."""


@dataclass(frozen=True, slots=True)
class Model:
    """One line of `sim.robot.ROBOTS`."""

    build: Callable[[Scene, Any], Vehicle]
    """The vehicle's class: puts one with the `parameters` into a scene, at rest at its start."""
    parameters: Parameters
    """Its numbers."""
    looks: Callable[[Any, tuple[float, float, float], tuple[float, float, float, float]], tuple[Shape, ...]]
    """The shapes to draw of one with its parameters, at a position [m], turned by a rotation."""
    element: Literal["land", "water", "air"] = "land"
    """Element in which it moves."""
    home: str = "parking_lot"
    """The world that it is put into when none is named."""


def suits(model: Model, world: World) -> bool:
    """Whether such a robot can be in this world."""
    return model.element == "air" or (model.element == "water") == (world.water is not None)


def numbered(models: Sequence[Model]) -> list[Model]:
    """The same, with distinct names: the second one of a kind is `Patrol-2`, and so on."""
    met: Counter[str] = Counter()
    return [_called(model, met) for model in models]


def _called(model: Model, met: Counter[str]) -> Model:
    info = model.parameters.info
    met[info.name] += 1
    if met[info.name] == 1:
        return model
    stem = info.name.rpartition("-")[0] or info.name
    own = structs.replace(info, name=f"{stem}-{met[info.name]}")
    return replace(model, parameters=structs.replace(model.parameters, info=own))
