"""A world and the robots in it, stepped in fixed steps."""

from __future__ import annotations

from collections.abc import Sequence

from sim.core.constants import STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.core.shapes import Shape, yaw_of
from sim.physics.backend_bullet import Bullet
from sim.rendering.camera import SharedRenderer
from sim.vehicles.model import Model, Vehicle, suits
from sim.vehicles.scene import Scene
from sim.world.tables import Start
from sim.world.weather import Weather
from sim.world.world import World

__all__ = ["Simulation"]

SETTLING_STEPS = STEPS_PER_SECOND // 2
"""Steps after which everything stands still on its wheels."""

MAX_OVERLAP = 0.01
"""Robots may start so far within something: shells are not exact [m]."""


class Simulation:
    """The true state of a world and its robots. Robots know it by their sensors only, tests read it directly."""

    def __init__(
        self,
        world: World,
        *robots: Model | tuple[Model, Start],
        seed: int = 0,
        noise: bool = True,
        gui: bool = False,
        draws_beside: bool = False,
    ) -> None:
        """`robots` in `world`, at its start or at their own; the same `seed` gives the same run, bit for bit.

        Cameras draw as `SharedRenderer` describes it, where `draws_beside` says so in a process of their own.

        Raises ValueError with one sentence when one of them does not belong into this world, or has no room at its start.
        """
        placed = [(entry, world.start) if isinstance(entry, Model) else entry for entry in robots]
        for model, _ in placed:
            _check(model, world)
        self.world = world
        self.backend = Bullet(gui=gui)
        self.backend.add_ground(world.bottom, world.ground.grip)
        self.dead_docks = {dock.name for dock in world.docks if not dock.live}
        """Names of the docks that have no current to give; may be changed."""
        platforms = self._built(world)
        self.renderer = SharedRenderer(world, beside=draws_beside)
        """The renderer of the robots' cameras."""
        self.weather = Weather(world, Noise(seed, "gusts", on=noise))
        self.vehicles: list[Vehicle] = [
            model.build(
                Scene(
                    self.backend,
                    world,
                    self.weather,
                    start,
                    seed,
                    noise,
                    number,
                    self.dead_docks,
                    platforms,
                ),
                model.parameters,
            )
            for number, (model, start) in enumerate(placed)
        ]
        self._refuse_overlaps(placed)
        self._looks = [model.looks for model, _ in placed]
        self.backend.show((world.start.x, world.start.y, world.start.z))
        self.steps = 0
        """Physics steps done."""
        for _ in range(SETTLING_STEPS):
            self._step()

    def _built(self, world: World) -> frozenset[int]:
        """Put what stands in the world into the physics; the numbers of what a drone may land on there."""
        # a door that stands open has no solids
        numbers = {self.backend.add_static(prop.solids): prop.kind for prop in world.props if prop.solids}
        return frozenset(number for number, kind in numbers.items() if kind == "pad")

    @property
    def vehicle(self) -> Vehicle:
        """The first robot."""
        return self.vehicles[0]

    @property
    def time(self) -> float:
        """Simulated since the start [s]."""
        return self.steps / STEPS_PER_SECOND

    @property
    def contacts(self) -> int:
        """Distinct bumps of the first robot with anything but the ground."""
        return self.vehicle.bumper.bumps

    def pose(self, number: int = 0) -> tuple[float, float, float]:
        """True pose of a robot: x, y [m] and yaw [rad] in `map`."""
        state = self.vehicles[number].state()
        return state.position[0], state.position[1], yaw_of(state.rotation)

    def looks(self, *, but: int) -> tuple[Shape, ...]:
        """Visible shapes of all robots and their payloads `but` one, of which only the payloads are visible."""
        shapes: list[Shape] = []
        for number, (vehicle, looks) in enumerate(zip(self.vehicles, self._looks, strict=True)):
            if number == but and not vehicle.attached:
                continue
            state = vehicle.state()
            if number != but:
                shapes += looks(vehicle.parameters, state.position, state.rotation)
            for attached in vehicle.attached:
                shapes += (shape.at(state.position, state.rotation) for shape in attached())
        return tuple(shapes)

    def advance(self) -> None:
        """One physics step."""
        self.weather.step()
        self._step()
        for vehicle in self.vehicles:
            vehicle.after_step()
        self.steps += 1

    def close(self) -> None:
        """Free the physics, and what cameras draw with."""
        self.renderer.close()
        self.backend.close()

    def _refuse_overlaps(self, placed: Sequence[tuple[Model, Start]]) -> None:
        """ValueError when a robot is put into something: the physics would fling it out."""
        for vehicle, (model, start) in zip(self.vehicles, placed, strict=True):
            if self.backend.is_crowded(vehicle.body, -MAX_OVERLAP, but=vehicle.raft):
                self.close()
                name, place = model.parameters.info.name, f"({start.x:g}, {start.y:g})"
                raise ValueError(
                    f"{name} has no room at {place} in {self.world.name}: something stands there."
                )

    def _step(self) -> None:
        for vehicle in self.vehicles:
            vehicle.before_step()
        self.backend.step()


def _check(model: Model, world: World) -> None:
    name = model.parameters.info.model
    if suits(model, world):
        return
    if world.water is None:
        raise ValueError(f"{name} needs water, and there is none in {world.name}.")
    raise ValueError(f"{name} needs dry land, and {world.name} is under water.")
