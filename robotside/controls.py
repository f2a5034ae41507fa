"""Who may move the robot, and for how long: authority, limits, the STOP latch and the watchdog.

Pure: every call is told the time. Times are seconds of the operators' clock, the one that `/rosapi/get_time` tells.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

from bridge.msgs.geometry_msgs import Twist, Vector3
from robotside.sticks import LET_GO, Sticks
from robotside.words import number, plain

__all__ = ["AHEAD", "LAPSE", "SILENT", "STOP_SENTENCE", "VALID", "Controls", "Driver", "Operator", "Ruling"]

VALID = 0.3
"""How long a drive command counts [s]; without a newer one the robot stops."""

LAPSE = 2.0
"""Control is free again when its driver was not heard for this long [s]."""

SILENT = 1.0
"""A driver who was not heard for this long may come back over another connection [s]; until then that is somebody else."""

AHEAD = 1.0
"""A command from further in the future than this comes from a wrong clock [s]."""

LONGEST_NAME = 40
"""Characters kept of what a client calls itself."""

LONGEST_ID = 64
"""Characters kept of a client's id."""

STOP_SENTENCE = "STOP is pressed; hold Release to drive again."


class Operator(Protocol):
    """Who commands over one connection: a session of the bridge server."""

    id: str
    address: str
    last_heard: float
    """When anything last came from it [s]."""


@dataclass(frozen=True, slots=True)
class Driver:
    """Who has control."""

    client_id: str
    name: str
    client: Operator


@dataclass(frozen=True, slots=True)
class Ruling:
    """What is to be done with a drive command."""

    twist: Twist | None
    """To pass to the robot at once; None when it must not be."""
    said: str = ""
    """Why not, as one sentence; empty when nobody needs to know."""


class Controls:
    """The one place that decides whether a command may move the robot."""

    def __init__(self, *, max_speed: float, max_yaw_rate: float) -> None:
        self._max_speed, self._max_yaw_rate = max_speed, max_yaw_rate
        self._driver: Driver | None = None
        self._names: dict[str, tuple[str, str]] = {}
        self._last_stamp: dict[str, float] = {}
        self._sticks = Sticks()
        self._driving_until: float | None = None
        self.stopped_by = ""
        """Who pressed STOP; empty when it is not pressed."""
        self.dropped = 0
        """Drive commands that were not obeyed since the start."""

    @property
    def driver(self) -> Driver | None:
        """Who has control; None when it is free."""
        return self._driver

    @property
    def stopped(self) -> bool:
        """STOP is latched."""
        return bool(self.stopped_by)

    @property
    def driving(self) -> bool:
        """A drive command is in force."""
        return self._driving_until is not None

    def introduce(self, client: Operator, client_id: str, name: str) -> None:
        """Remember what `client` calls itself, cut to a readable line; empty words change nothing."""
        client_id, name = plain(client_id, LONGEST_ID), plain(name, LONGEST_NAME)
        known_id, known_name = self._identity(client)
        self._names[client.id] = (client_id or known_id, name or known_name)

    def knows(self, client: Operator) -> bool:
        """`client` has introduced itself and is still connected."""
        return client.id in self._names

    def name(self, client: Operator) -> str:
        """What to call `client`."""
        return self._identity(client)[1]

    def id(self, client: Operator) -> str:
        """The `client_id` that `client` gave, or one for its connection."""
        return self._identity(client)[0]

    def _identity(self, client: Operator) -> tuple[str, str]:
        return self._names.get(client.id, (client.id, f"a client at {client.address}"))

    def acquire(self, client: Operator, now: float) -> str:
        """Give control to `client` if it is free or its own; returns why not, empty when it has it now."""
        self.lapse(now)
        problem = self.objection(client)
        if problem:
            return problem
        client_id, name = self._identity(client)
        self._driver = Driver(client_id, name, client)
        return ""

    def release(self, client: Operator) -> str:
        """Take control from `client`; returns why not, empty when it is free now."""
        problem = self.objection(client, "only its holder can release it")
        if problem:
            return problem
        self._driver = None
        return ""

    def objection(self, client: Operator, advice: str = "ask there, or wait until it is released") -> str:
        """Why `client` may not change what the robot will do, with an `advice`; empty when it may.

        One id may drive over one connection: another with the same counts as the same only when the first has been
        silent, as one that was cut is.
        """
        held = self._driver
        if held is None or client.id == held.client.id:
            return ""
        if self.id(client) != held.client_id:
            return f"{held.name} has control; {advice}."
        if client.last_heard - held.client.last_heard > SILENT:
            return ""
        return f"{held.name} has control over another connection with the same client_id; {advice}."

    def lapse(self, now: float) -> str:
        """Free control whose driver fell silent; returns the driver's name when that happened, else empty."""
        if self._driver is None or now - self._driver.client.last_heard <= LAPSE:
            return ""
        name, self._driver = self._driver.name, None
        return name

    def gone(self, client: Operator) -> bool:
        """Forget a client whose socket closed; True when it was driving, so that the robot must stop."""
        self._names.pop(client.id, None)
        self._last_stamp.pop(client.id, None)
        self._sticks.forget(client.id)
        if self._driver is None or self._driver.client.id != client.id:
            return False
        self._driver = None
        was_driving, self._driving_until = self.driving, None
        return was_driving

    def stop(self, name: str) -> None:
        """Latch STOP; from anyone, any time. A stick that is held meanwhile has to come to rest before it counts."""
        self.stopped_by = self.stopped_by or name
        self.halt()

    def release_stop(self) -> None:
        """Unlatch STOP; nothing moves by that alone."""
        self.stopped_by = ""

    def drive(
        self,
        client: Operator,
        twist: Twist,
        now: float,
        *,
        stamp: float | None = None,
        auto: bool = False,
        trouble: str = "",
    ) -> Ruling:
        """Judge a drive command that has just come; `stamp` is when it was given [s], None when nobody said.

        While the robot drives itself (`auto`), a command of zero means a stick at rest and changes nothing. `trouble` says
        why the robot cannot be driven at all, empty when it can. A stick that was pushed in vain, or for longer than a
        moment without being obeyed, counts again once it was at rest.
        """
        said, moving = self._fault(client, twist, now, stamp), not _zero(twist)
        given = now if stamp is None or math.isnan(stamp) else stamp
        counts = not _finite(twist) or self._sticks.hear(client.id, moving, given, now)
        if not said and (moving or not (auto or trouble or self.stopped)):
            said = trouble or self._refusal(client, now, counts)
            if not said:
                self._sticks.obey(client.id, now)
                self._driving_until = now + VALID
                return Ruling(self._limited(twist))
            self._sticks.void(client.id)
        self.dropped += bool(said)
        return Ruling(None, said)

    def _refusal(self, client: Operator, now: float, counts: bool) -> str:
        """Why a sound command of `client` is not obeyed; empty when it is, and then it has control."""
        if self.stopped:
            return STOP_SENTENCE
        return self.acquire(client, now) if counts else LET_GO

    def expired(self, now: float) -> bool:
        """True once when the last drive command has run out, so that the robot must stop."""
        if self._driving_until is None or now < self._driving_until:
            return False
        self._driving_until = None
        return True

    def hold(self) -> None:
        """End the drive command in force: the robot drives itself from now on."""
        self._driving_until = None

    def halt(self) -> None:
        """End the drive command in force: the robot was stopped otherwise, and no stick counts before it was at rest."""
        self.hold()
        self._sticks.void_all()

    def _fault(self, client: Operator, twist: Twist, now: float, stamp: float | None) -> str:
        if not _finite(twist):
            return "A drive command was dropped: its speeds are not all numbers."
        if stamp is None or math.isnan(stamp):
            return ""
        if now - stamp > VALID:
            return f"A drive command was dropped: it came {number(now - stamp)} s late and is valid for {VALID} s."
        if stamp - now > AHEAD:
            return f"A drive command was dropped: its clock is {number(stamp - now)} s ahead of the robot's."
        if stamp <= self._last_stamp.get(client.id, -math.inf):
            return "A drive command was dropped: a newer one came before it."
        self._last_stamp[client.id] = stamp
        return ""

    def _limited(self, twist: Twist) -> Twist:
        v, w, turn = twist.linear, twist.angular, self._max_yaw_rate
        speed = math.hypot(v.x, v.y, v.z)
        scale = self._max_speed / speed if speed > self._max_speed else 1.0
        return Twist(
            Vector3(v.x * scale, v.y * scale, v.z * scale),
            Vector3(_clamp(w.x, turn), _clamp(w.y, turn), _clamp(w.z, turn)),
        )


def _numbers(twist: Twist) -> tuple[float, ...]:
    v, w = twist.linear, twist.angular
    return v.x, v.y, v.z, w.x, w.y, w.z


def _finite(twist: Twist) -> bool:
    return all(map(math.isfinite, _numbers(twist)))


def _zero(twist: Twist) -> bool:
    return not any(_numbers(twist))


def _clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
