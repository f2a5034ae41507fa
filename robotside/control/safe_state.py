"""Safe states per kind of robot, taken when the link or the driver is lost.

Pure: what the robot measures and the time are passed in; what comes out goes to the robot's port. A robot side that
dies cannot do any of this: there the robot's own drive has to.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace

from bridge.core.units import wrap
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.config import SafeStateSettings
from robotside.kinds.registry import kind_of
from robotside.motion.measured import MeasuredState
from robotside.motion.speed_limit import within

__all__ = ["BRAKE", "Act", "SafeState"]

TURN_GAIN, TURN_MOST = 0.8, 0.4
"""Towards the heading that is held [1/s, rad/s]."""
LEVEL_GAIN, LEVEL_MOST = 1.0, 0.3
"""Towards lying level [1/s, rad/s]."""
DEPTH_GAIN, DEPTH_MOST = 0.8, 0.2
"""Towards the depth or height that is held [1/s, m/s]."""
RISING, SINKING = 0.2, 0.3
"""How fast it surfaces, and lands [m/s]."""
SURFACE, GROUND = -0.10, 0.08
"""From this height on it has surfaced, up to this one it has landed [m]."""
SURFACE_DEPTH = 0.3
"""So much lower than the surface one that floats may be tossed, once it is there [m]."""
MAX_ENDING_TIME = 120.0
"""Surfacing or landing ends after this at the latest, for one that does not measure its height [s]."""
MAX_REST_SPEED = 0.02
"""Slower than this it stands [m/s]."""
STRAIGHTENING_TIME = 1.0
"""So long front wheels take at most to come straight; a truck that brakes hard stands before [s]."""
MAX_BRAKING_TIME = 10.0
"""Braking straight ends after this at the latest, for one that does not measure its speed [s]."""


@dataclass(frozen=True, slots=True)
class Act:
    """What the robot is to do now."""

    twist: Twist | None
    """To drive with; None for braking to rest and staying there."""
    phase: str = ""
    """What it is about, as an event tells it: `holds its depth`."""
    home: bool = False
    """It is to go home by a task of its own, if it can."""
    order: Manoeuvre | None = None
    """In place of the twist, for a robot that does this better by itself; to be given once."""


BRAKE = Act(None, "brakes")
_AT_REST = Act(None, "is at rest")


class SafeState:
    """The safe state of one robot. It is entered when a command has run out, and left when somebody drives or a task begins."""

    def __init__(self, kind: str, settings: SafeStateSettings, knows: Collection[str] = ()) -> None:
        """`settings` go before what robots of a `kind` usually do; an unknown kind brakes.

        `knows` are the manoeuvres that it can be told in place of twists.
        """
        self._knows = knows
        usual = kind_of(kind).safe_state
        self._action = settings.action or usual.action
        self._usual_then: str = settings.then or usual.then
        self._then: str = self._usual_then
        self._hold_for = usual.hold_for if settings.hold_for is None else settings.hold_for
        if settings.then and settings.hold_for is None and math.isinf(self._hold_for):
            self._hold_for = 30.0
        self._begun: float | None = None
        self._lost: float | None = None
        self._after: float | None = None
        self._arrived = False
        self._held = MeasuredState()
        self._acts: dict[str, Callable[[float, MeasuredState], Act]] = {
            "brake": lambda _, __: BRAKE,
            "brake_straight": self._brake_straight,
            "hold_heading": self._hold_heading,
            "hold_depth": self._hold_depth,
            "hover": self._hover,
        }
        self._afterwards: dict[str, Callable[[float, MeasuredState], Act]] = {
            "surface": self._surface,
            "land": self._land,
            "return": lambda _, __: Act(None, "goes home", home=True),
        }

    @property
    def active(self) -> bool:
        """It is in its safe state."""
        return self._begun is not None

    @property
    def brakes(self) -> bool:
        """All that it does is to brake, and to stay where it is."""
        return self._action in ("brake", "brake_straight") and self._usual_then == "stay"

    def enter(self, now: float, measured: MeasuredState) -> None:
        """No one drives the robot from `now` on [s]; it holds what is `measured` now. Calling it again changes nothing."""
        if self._begun is None:
            self._begun, self._held = now, measured

    def leave(self) -> None:
        """Somebody or something drives it."""
        self._begun = self._lost = self._after = None
        self._arrived = False
        self._then = self._usual_then

    def cannot_return(self) -> None:
        """It cannot go home, or has been there: until it is left it comes down, or up, or stays where it is."""
        self._then = {"hover": "land", "hold_depth": "surface"}.get(self._action, "stay")

    def step(self, now: float, measured: MeasuredState, *, lost: bool) -> Act:
        """What to do at `now` [s]; `lost` while there is no one who could drive it. One that charges stays where it is."""
        if self._begun is None:
            return BRAKE
        lost = lost and not measured.charging  # it is where it should be
        self._lost = (now if self._lost is None else self._lost) if lost else None
        due = self._lost is not None and now - self._lost >= self._hold_for
        if self._then == "stay" or not (due or self._after is not None):
            self._after = None
            return self._acts[self._action](now - self._begun, measured)
        if not lost:
            # somebody is back in mid-way: it stays where it is now
            self._after, self._begun, self._held, self._arrived = None, now, measured, False
            return self._acts[self._action](0.0, measured)
        self._after = now if self._after is None else self._after
        return self._afterwards[self._then](now - self._after, measured)

    def _brake_straight(self, since: float, measured: MeasuredState) -> Act:
        """No speed and the wheels straight, so that it does not swing into what is beside it."""
        if since >= MAX_BRAKING_TIME or (
            since >= STRAIGHTENING_TIME and measured.moving.speed < MAX_REST_SPEED
        ):
            return _AT_REST
        return Act(Twist(), "brakes straight")

    def _hold_heading(self, _: float, measured: MeasuredState) -> Act:
        twist = Twist(angular=Vector3(0.0, 0.0, self._turning(measured)))
        return self._by("hover", Act(twist, "idles and holds its heading"))

    def _hold_depth(self, _: float, measured: MeasuredState) -> Act:
        twist = Twist(Vector3(0.0, 0.0, self._rising(measured)), self._levelling(measured))
        return self._by("hover", Act(twist, "holds its depth"))

    def _hover(self, _: float, measured: MeasuredState) -> Act:
        twist = Twist(Vector3(0.0, 0.0, self._rising(measured)), Vector3(0.0, 0.0, self._turning(measured)))
        return self._by("hover", Act(twist, "hovers"))

    def _surface(self, since: float, measured: MeasuredState) -> Act:
        act = self._by(
            "surface", Act(Twist(Vector3(0.0, 0.0, RISING), self._levelling(measured)), "surfaces")
        )
        if not (self._arrived or measured.height >= SURFACE or since >= MAX_ENDING_TIME):
            return act
        self._arrived = True
        sinks = measured.height < SURFACE - (SURFACE_DEPTH if act.order else 0.0) and since < MAX_ENDING_TIME
        return replace(act, phase="has surfaced") if sinks else Act(None, "has surfaced")

    def _land(self, since: float, measured: MeasuredState) -> Act:
        turn = Vector3(0.0, 0.0, self._turning(measured))
        act = self._by("land", Act(Twist(Vector3(0.0, 0.0, -SINKING), turn), "lands"))
        low = act.order is None and (
            measured.height <= GROUND or since >= MAX_ENDING_TIME
        )  # it does not say it itself
        self._arrived = self._arrived or measured.landed or low
        if not self._arrived:
            return act
        return _AT_REST if self._held.landed else Act(None, "has landed")

    def _by(self, kind: str, act: Act) -> Act:
        """`act`, by a manoeuvre where the robot knows it: it holds what it has when it is told."""
        return replace(act, order=Manoeuvre(kind=kind)) if kind in self._knows else act

    def _turning(self, measured: MeasuredState) -> float:
        """Towards the heading at the beginning; 0 when it is not known."""
        if measured.pose is None or self._held.pose is None:
            return 0.0
        return within(TURN_GAIN * wrap(self._held.pose.yaw - measured.pose.yaw), TURN_MOST)

    def _rising(self, measured: MeasuredState) -> float:
        """Towards the height at the beginning; 0 when it is not known."""
        off = self._held.height - measured.height
        return 0.0 if math.isnan(off) else within(DEPTH_GAIN * off, DEPTH_MOST)

    def _levelling(self, measured: MeasuredState) -> Vector3:
        roll, pitch = (within(-LEVEL_GAIN * tilt, LEVEL_MOST) for tilt in (measured.roll, measured.pitch))
        return Vector3(roll, pitch, self._turning(measured))
