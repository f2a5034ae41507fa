"""Mishaps of a robot, reported to its operator: it turns over, sinks, leaves the world, or its dock has no current."""

from __future__ import annotations

from collections.abc import Iterator

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event
from sim.core.constants import STEPS_PER_SECOND
from sim.core.parameters import Info
from sim.core.shapes import rotate
from sim.physics.backend_bullet import State
from sim.vehicles.scene import Scene
from sim.world.tables import Dock

__all__ = ["Mishaps"]

CHECK_RATE = 10
"""Checks in a second."""
CHECK_STEPS = STEPS_PER_SECOND // CHECK_RATE
"""Steps between two checks."""
CONFIRM_CHECKS, SINKING_CHECKS = CHECK_RATE // 2, 4 * CHECK_RATE
"""Checks for which it must last, and for which a boat must be under water: a sea that breaks over it passes."""
CLEAR_CHECKS = 2 * CHECK_RATE
"""Checks without it after which it has ended, so that it may be reported anew."""
OUTSIDE_MARGIN = 3.0
"""Distance beyond the ground's edge at which it has left the world [m]."""
_MIN_UPRIGHT = 0.2
"""Cosine of a tilt from which on it has turned over."""
_SUNK_DEPTH = 0.4
"""Depth under the surface where it is, waves and all, from which on what floats or flies has sunk [m]."""


class _Condition:
    """One mishap: it is reported once, and again only after it has ended."""

    def __init__(self, patience: int) -> None:
        """It must last for `patience` checks."""
        self._patience = patience
        self._lasts = self._gone = 0
        self._reported = False

    def update(self, happens: bool) -> bool:
        """Whether to report it now."""
        self._lasts = self._lasts + 1 if happens else 0
        self._gone = 0 if happens else self._gone + 1
        if self._gone >= CLEAR_CHECKS:
            self._reported = False
        if self._reported or self._lasts < self._patience:
            return False
        self._reported = True
        return True


class Mishaps:
    """Checks one robot; each mishap is reported once, until it is over."""

    def __init__(self, info: Info, scene: Scene) -> None:
        """A robot in `scene`; one that dives may lie anyhow and deep."""
        self._name, self._world, self._weather = info.name, scene.world, scene.weather
        self._dives = info.dives
        self._dead_docks = scene.dead_docks
        self._drowning = SINKING_CHECKS if info.floats else CONFIRM_CHECKS
        self._active: dict[Code, _Condition] = {}

    def is_due(self, steps: int) -> bool:
        """Whether to check after so many physics `steps`."""
        return steps % CHECK_STEPS == 0

    def update(self, state: State, dock: Dock | None = None) -> Iterator[Event]:
        """Events to report now; the robot's contacts touch those of `dock`."""
        yield from self._of_dock(state, dock)
        parameters = {Code.ROBOT_ASTRAY: [KeyValue("world", self._world.name)]}
        for code, text, patience, happens in self._conditions(state):
            if self._active.setdefault(code, _Condition(patience)).update(happens):
                yield Event(
                    level="alarm",
                    kind="robot",
                    text=f"{self._name} {text}.",
                    position=Point(*state.position),
                    code=code.value,
                    parameters=[KeyValue("robot", self._name), *parameters.get(code, [])],
                )

    def _of_dock(self, state: State, dock: Dock | None) -> Iterator[Event]:
        """It touches a dock that has no current: in whatever way it came there."""
        dead = dock is not None and dock.name in self._dead_docks
        watched = self._active.setdefault(Code.DOCK_DEAD, _Condition(CONFIRM_CHECKS))
        if watched.update(dead) and dock is not None:
            yield Event(
                level="warn",
                kind="robot",
                text=f"{self._name} touches {dock.name}, which has no current to give.",
                position=Point(*state.position),
                code=Code.DOCK_DEAD.value,
                parameters=[KeyValue("place", dock.name)],
            )

    def clear(self) -> None:
        """Forget all mishaps: the robot was put back."""
        self._active.clear()

    def _conditions(self, state: State) -> Iterator[tuple[Code, str, int, bool]]:
        """Each mishap and the words for it after the robot's name, for how many checks it must last, and whether it is so now."""
        x, y, z = state.position
        ground = self._world.ground
        if not self._dives:
            over = rotate(state.rotation, (0.0, 0.0, 1.0))[2] < _MIN_UPRIGHT
            yield Code.ROBOT_OVERTURNED, "has turned over", CONFIRM_CHECKS, over
        if self._world.water and not self._dives:
            sunk = self._weather.surface(x, y) - z > _SUNK_DEPTH
            yield Code.ROBOT_SUNK, "has sunk", self._drowning, sunk
        gone = abs(x) > ground.length / 2 + OUTSIDE_MARGIN or abs(y) > ground.width / 2 + OUTSIDE_MARGIN
        yield Code.ROBOT_ASTRAY, f"has left {self._world.name}", CONFIRM_CHECKS, gone
