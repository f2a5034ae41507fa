"""What goes wrong with a robot, as its operator is told: it lies on its back, it sinks, it leaves the world."""

from __future__ import annotations

from collections.abc import Iterator

from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event
from sim.backend_bullet import STEPS_PER_SECOND, State
from sim.shapes import rotate
from sim.vehicles.parameters import Info
from sim.world import World

__all__ = ["Mishaps"]

EVERY = STEPS_PER_SECOND // 10
"""Steps between two looks."""
PATIENCE = 5
"""Looks for which it must last."""
OUTSIDE = 3.0
"""How far beyond the ground's edge it may be [m]."""
_UPSIDE_DOWN = 0.2
"""Cosine of a tilt from which on it has turned over."""
_SUNK = -0.4
"""Height below which what floats or flies has sunk [m]."""


class Mishaps:
    """Looks at one robot; each mishap is told once, until it is over."""

    def __init__(self, info: Info, world: World) -> None:
        """A robot in `world`; of the kinds that may lie anyhow, or dive, that is not told."""
        self._name, self._world = info.name, world
        self._may_turn_over = self._may_dive = info.kind == "hexapod"
        self._lasts: dict[str, int] = {}

    def due(self, steps: int) -> bool:
        """Whether to look after so many physics `steps`."""
        return steps % EVERY == 0

    def look(self, state: State) -> Iterator[Event]:
        """What is to be told now."""
        for text, happens in self._signs(state):
            lasts = self._lasts.get(text, 0) + 1 if happens else 0
            self._lasts[text] = lasts
            if lasts == PATIENCE:
                yield Event(level="alarm", kind="robot", text=text, position=Point(*state.position))

    def _signs(self, state: State) -> Iterator[tuple[str, bool]]:
        x, y, z = state.position
        ground, name = self._world.ground, self._name
        if not self._may_turn_over:
            yield f"{name} has turned over.", rotate(state.rotation, (0.0, 0.0, 1.0))[2] < _UPSIDE_DOWN
        if self._world.water and not self._may_dive:
            yield f"{name} has sunk.", z < _SUNK
        gone = abs(x) > ground.length / 2 + OUTSIDE or abs(y) > ground.width / 2 + OUTSIDE
        yield f"{name} has left {self._world.name}.", gone
