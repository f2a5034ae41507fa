"""The surroundings of a vehicle: the physics, the world with its weather, and the seed of the random errors."""

from __future__ import annotations

from dataclasses import dataclass, field

from sim.core.noise import Noise
from sim.physics.backend_bullet import Bullet
from sim.world.tables import Start
from sim.world.weather import Weather
from sim.world.world import World

__all__ = ["Scene"]


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything round one vehicle."""

    backend: Bullet
    world: World
    weather: Weather
    start: Start
    """Start place, on the ground, afloat or under water."""
    seed: int = 0
    noise: bool = True
    """With False every sensor is exact."""
    number: int = 0
    """Which of the vehicles of this world it is, from 0 on."""
    dead_docks: set[str] = field(default_factory=set)
    """Names of the docks that have no current to give just now; may change."""
    platforms: frozenset[int] = frozenset()
    """Numbers of the bodies that what flies lands on."""

    def generator(self, sensor: str) -> Noise:
        """The random errors of one of its sensors, independent of all others."""
        name = sensor if self.number == 0 else f"{self.number}/{sensor}"
        return Noise(self.seed, name, on=self.noise)
