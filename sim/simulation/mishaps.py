"""What goes wrong with a robot, as its operator is told: it lies on its back, it sinks, it leaves the world."""

from __future__ import annotations

from collections.abc import Iterator

from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event
from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Info
from sim.core.shapes import rotate
from sim.physics.backend_bullet import State
from sim.vehicles.scene import Scene

__all__ = ["Mishaps"]

LOOKS = 10
"""In a second."""
EVERY = STEPS_PER_SECOND // LOOKS
"""Steps between two looks."""
PATIENCE, DROWNING = LOOKS // 2, 4 * LOOKS
"""Looks for which it must last, and for which a boat must be under water: a sea that breaks over it passes."""
OVER = 2 * LOOKS
"""Looks without it after which it has ended, so that it may be told anew."""
OUTSIDE = 3.0
"""How far beyond the ground's edge it may be [m]."""
_UPSIDE_DOWN = 0.2
"""Cosine of a tilt from which on it has turned over."""
_SUNK = 0.4
"""Depth under the surface where it is, waves and all, from which on what floats or flies has sunk [m]."""


class _Sign:
    """One thing that may go wrong: it is told once, and again only after it had ended."""

    def __init__(self, patience: int) -> None:
        """It must last for `patience` looks."""
        self._patience = patience
        self._lasts = self._gone = 0
        self._told = False

    def look(self, happens: bool) -> bool:
        """Whether it is to be told now."""
        self._lasts = self._lasts + 1 if happens else 0
        self._gone = 0 if happens else self._gone + 1
        if self._gone >= OVER:
            self._told = False
        if self._told or self._lasts < self._patience:
            return False
        self._told = True
        return True


class Mishaps:
    """Looks at one robot; each mishap is told once, until it is over."""

    def __init__(self, info: Info, scene: Scene) -> None:
        """A robot in `scene`; one that dives may lie anyhow and deep."""
        self._name, self._world, self._weather = info.name, scene.world, scene.weather
        self._dives = info.dives
        self._drowning = DROWNING if info.floats else PATIENCE
        self._signs: dict[str, _Sign] = {}

    def due(self, steps: int) -> bool:
        """Whether to look after so many physics `steps`."""
        return steps % EVERY == 0

    def look(self, state: State) -> Iterator[Event]:
        """What is to be told now."""
        for text, patience, happens in self._seen(state):
            if self._signs.setdefault(text, _Sign(patience)).look(happens):
                yield Event(level="alarm", kind="robot", text=text, position=Point(*state.position))

    def end(self) -> None:
        """Somebody put the robot back: whatever was wrong is over."""
        self._signs.clear()

    def _seen(self, state: State) -> Iterator[tuple[str, int, bool]]:
        """What may go wrong, for how many looks it must last, and whether it is so now."""
        x, y, z = state.position
        ground, name = self._world.ground, self._name
        if not self._dives:
            over = rotate(state.rotation, (0.0, 0.0, 1.0))[2] < _UPSIDE_DOWN
            yield f"{name} has turned over.", PATIENCE, over
        if self._world.water and not self._dives:
            yield f"{name} has sunk.", self._drowning, self._weather.surface(x, y) - z > _SUNK
        gone = abs(x) > ground.length / 2 + OUTSIDE or abs(y) > ground.width / 2 + OUTSIDE
        yield f"{name} has left {self._world.name}.", PATIENCE, gone
