"""A world and the robot in it, stepped in fixed steps."""

from __future__ import annotations

from sim.backend_bullet import STEPS_PER_SECOND, Bullet
from sim.shapes import yaw_of
from sim.vehicles.model import Model, Vehicle
from sim.world import World

__all__ = ["Simulation"]


class Simulation:
    """The truth: what really is where. Sensors tell robots about it, tests look at it directly."""

    def __init__(
        self, world: World, model: Model, *, seed: int = 0, noise: bool = True, gui: bool = False
    ) -> None:
        """A robot of `model` at the start of `world`; the same `seed` gives the same run, bit for bit."""
        self.world = world
        self.backend = Bullet(gui=gui)
        self.backend.add_ground()
        for prop in world.props:
            self.backend.add_static(prop.solids)
        self.vehicle: Vehicle = model.build(
            self.backend, world, seed=seed, noise=noise, parameters=model.parameters
        )
        self.steps = 0
        """Physics steps done."""

    @property
    def time(self) -> float:
        """Simulated since the start [s]."""
        return self.steps / STEPS_PER_SECOND

    @property
    def contacts(self) -> int:
        """Distinct bumps of the robot with anything but the ground."""
        return self.vehicle.bumper.bumps

    def pose(self) -> tuple[float, float, float]:
        """Where the robot really is: x, y [m] and yaw [rad] in `map`."""
        state = self.vehicle.state()
        return state.position[0], state.position[1], yaw_of(state.rotation)

    def advance(self) -> None:
        """One physics step."""
        self.vehicle.advance()
        self.steps += 1

    def close(self) -> None:
        """Free the physics."""
        self.backend.close()
