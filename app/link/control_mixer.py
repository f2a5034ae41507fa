"""Several controls make one order: what each of them says is added up, and becomes a twist or a manoeuvre.

A stick says how fast ahead and how fast round, a slider nothing by itself, a lever the throttle, a circle how far the
robot leans. Which of it a layout has is written in its file; which of it the robot knows it says itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Hashable, Mapping
from dataclasses import dataclass, fields
from typing import Self

from app.link.drive_slot import Drive
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre

__all__ = ["PARTS", "Parts", "ControlMixer", "Reach", "order"]


@dataclass(frozen=True, slots=True)
class Parts:
    """What one control says, or all of them together."""

    ahead: float = 0.0
    """[m/s]"""
    aside: float = 0.0
    """To the left [m/s]."""
    climb: float = 0.0
    """[m/s]"""
    turn: float = 0.0
    """Anticlockwise [rad/s]."""
    throttle: float = 0.0
    """Share of the full power, -1 to 1."""
    steering: float = 0.0
    """Of the front wheels or the rudder, positive to the left [rad]."""
    roll: float = 0.0
    """To hold, positive leans to the right [rad]."""
    pitch: float = 0.0
    """To hold, positive nose down [rad]."""

    @classmethod
    def of(cls, said: Drive) -> Self:
        """What a twist or a manoeuvre of the kind `twist`, `steer` or `tilt` says; what it leaves open is nothing."""
        if isinstance(said, Twist):
            return cls(said.linear.x, said.linear.y, said.linear.z, said.angular.z)
        if said.kind == "steer":
            return cls(_given(said.speed), throttle=_given(said.throttle), steering=said.steering)
        if said.kind == "tilt":
            twist, ahead = said.twist, _given(said.speed)
            return cls(ahead, climb=twist.linear.z, turn=twist.angular.z, roll=said.roll, pitch=said.pitch)
        return cls.of(said.twist)

    def __add__(self, other: Parts) -> Parts:
        return Parts(*(getattr(self, name) + getattr(other, name) for name in PARTS))

    @property
    def rest(self) -> bool:
        """Nothing is wanted."""
        return self == Parts()


PARTS: tuple[str, ...] = tuple(field.name for field in fields(Parts))
"""What a control may say."""


@dataclass(frozen=True, slots=True)
class Reach:
    """What the controls mean at the end of their way."""

    speed: float = 0.5
    """Along any direction [m/s]."""
    yaw_rate: float = 1.0
    """[rad/s]"""
    climb: float = 0.0
    """[m/s]; 0 for a robot that stays on the ground or the water."""
    tilt: float = 0.3
    """[rad]"""
    steering: float = 0.5
    """[rad]"""

    def of(self, part: str) -> float:
        """Of one of `PARTS`, in its unit."""
        return {
            "ahead": self.speed,
            "aside": self.speed,
            "climb": self.climb,
            "turn": self.yaw_rate,
            "throttle": 1.0,
            "steering": self.steering,
            "roll": self.tilt,
            "pitch": self.tilt,
        }[part]


def order(parts: Parts, kinds: Collection[str], reach: Reach, says: Collection[str] = PARTS) -> Drive:
    """What the robot is told: rest is a twist of zeros, and a manoeuvre is told only where a twist does not say it.

    `kinds` are the manoeuvres that the robot knows, `says` what the controls may say at all. To a robot that does not
    know steering or tilting the same push of a control says as much of a turn or of a speed.
    """
    if parts.rest:
        return Twist()
    # a flying robot whose circle is let go stands still in the air by a twist; a swimming one that goes ahead shall be level
    if "tilt" in kinds and (parts.roll or parts.pitch or (parts.ahead and "pitch" in says)):
        turning = Twist(Vector3(0.0, 0.0, parts.climb), Vector3(0.0, 0.0, parts.turn))
        speed = parts.ahead or math.nan
        return Manoeuvre(kind="tilt", twist=turning, roll=parts.roll, pitch=parts.pitch, speed=speed)
    if "steer" in kinds and not {"steering", "throttle"}.isdisjoint(says):
        throttle = parts.throttle or math.nan
        speed = math.nan if parts.throttle else parts.ahead
        return Manoeuvre(kind="steer", steering=parts.steering, speed=speed, throttle=throttle)
    return _twist(parts, reach)


def _twist(parts: Parts, reach: Reach) -> Twist:
    """The same in speeds alone."""
    share = Parts(*(getattr(parts, name) / (reach.of(name) or math.inf) for name in PARTS))
    ahead = parts.ahead + reach.speed * (share.throttle + share.pitch)
    aside = parts.aside - reach.speed * share.roll
    turn = parts.turn + reach.yaw_rate * share.steering
    # + 0.0 turns the minus zero of a control at rest into zero
    return Twist(Vector3(ahead + 0.0, aside + 0.0, parts.climb + 0.0), Vector3(0.0, 0.0, turn + 0.0))


def _given(value: float) -> float:
    return 0.0 if math.isnan(value) else value


class ControlMixer:
    """The controls of one screen. It tells the robot what they say together, at every change of any."""

    def __init__(
        self,
        send: Callable[[Drive], object],
        kinds: Callable[[], Collection[str]],
        reach: Callable[[], Reach] = Reach,
        says: Collection[str] = PARTS,
        amend: Callable[[Drive], object] | None = None,
    ) -> None:
        """`send` drives the robot, `amend` only one that is driven already; `kinds` are the manoeuvres that it knows now, `reach` what the controls mean at their ends.

        `says` is which of `PARTS` the controls may say at all.
        """
        self._send, self._kinds, self._reach, self._says = send, kinds, reach, frozenset(says)
        self._amend = amend or send
        self._said: dict[Hashable, Parts] = {}

    def set_parts(self, control: Hashable, parts: Parts) -> None:
        """A control says something else than before; all of it together is sent. What is not finite counts as rest of that control."""
        self._keep(control, parts)
        self._send(self.order)

    def retake(self, said: Mapping[Hashable, Parts]) -> None:
        """What a push means has changed: each control says this now. Only what is pushed counts, and it is sent at once."""
        held = [control for control in said if control in self._said]
        for control in held:
            self._keep(control, said[control])
        if held:
            self._amend(self.order)

    def _keep(self, control: Hashable, parts: Parts) -> None:
        if parts.rest or not all(math.isfinite(getattr(parts, name)) for name in PARTS):
            self._said.pop(control, None)
        else:
            self._said[control] = parts

    @property
    def parts(self) -> Parts:
        """What all controls say together."""
        return sum(self._said.values(), Parts())

    @property
    def order(self) -> Drive:
        """What the robot is told by it."""
        return order(self.parts, self._kinds(), self._reach(), self._says)
