"""A robot side as the explorer drives it: the product's own door, services, authority, gate, expiry, latch and port guard.

Only the body, the people and the disk are of the test: a body that notes what moves it, three people whose roles are watch,
drive and manage, a stranger, and rows in memory that outlive a restart. Beside it runs a short account of what must hold,
kept by what was asked and answered alone; `Violation` says where the robot side differs from it.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterable
from typing import Any

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest, RobotInfo
from robotside.control.command_expiry import VALID_TIME
from robotside.door.station_door import StationDoor
from robotside.records import Records
from robotside.records.database.jobs import Job
from robotside.records.database.rows import Content, empty
from robotside.station.station import Station
from robotside.trust.permissions import needed_role
from tests.slow.snapshots import NOTHING

__all__ = ["EVENTS", "PEOPLE", "ExploredRobot", "Violation", "rows", "value"]

PEOPLE = {
    "W": Identity("w", "Wim", Role.WATCH, proven=True),
    "D": Identity("d", "Dora", Role.DRIVE, proven=True),
    "M": Identity("m", "Max", Role.MANAGE, proven=True),
    "S": STRANGER,
}
AHEAD, REST = Twist.planar(0.3, 0.0), Twist()
BEGIN = 1_000_000.0
"""The clock at the start [s]: far from every other number, so that a time is told from it."""
PAST_COUNTS = frozenset({"ExploredRobot.given", "Operator.last_heard", "_Since.time", "_Hold.begun"})
"""Times of which it counts how long ago they were; all others have passed or not."""
RELEASE_PAUSE = 3.0
"""From a release of STOP to the next hold [s]."""
MAX_PAST = 6.0
"""No time is looked at that was longer ago [s]."""
SETTLE = 0.1
"""Longest time between two steps of the robot side [s]."""

EVENTS = {
    "lapses of one driver": (
        "D push", "D blind", "D late", "D zero", "D freeze", "D cut", "D expire", "D remove", "wait 0.1", "wait 0.3",
        "wait 2.1",
    ),
    "two drivers": (
        "D push", "D zero", "D release", "D cut", "D freeze", "M push", "M zero", "M acquire", "W push", "S push",
        "wait 0.1", "wait 0.3", "wait 2.1",
    ),
    "handover": (
        "D push", "D grant", "D object", "D release", "D freeze", "M request", "M release", "M push", "W request",
        "W grant", "D remove", "wait 0.3", "wait 2.1", "wait 10.1",
    ),
    "STOP": (
        "D push", "D zero", "D stop", "S stop", "D hold", "D unlatch", "D cut", "M hold", "M unlatch", "M acquire",
        "W hold", "S hold", "S unlatch", "wait 1.1", "wait 4.1",
    ),
}  # fmt: skip
"""By theme what can happen, beside a kill with a restart; all sequences of each are gone through.

A blind push has no stamp, a late one was given before the last pause, and a cut is followed by another connection.
"""


class Violation(AssertionError):
    """The robot side did what must not be."""


def rows() -> Content:
    """What is kept at first: nothing."""
    return empty() | {"facts": {"log": "b1"}}


class _Disk:
    """Writes at once."""

    def submit(self, job: Job, told: Callable[[Job, str], None]) -> bool:
        told(job, "")
        return True


class _People:
    """The gate: whose token it is, and the product's own table of roles."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return STRANGER

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        return PEOPLE[token]

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


class _Body:
    """Notes whether it moves, and counts the orders to move."""

    trouble = ""

    def __init__(self) -> None:
        self.info = RobotInfo("Body-1", "wheels", "body", "Differential drive", "hall", 0.7, 1.9, 0.18)
        self.moves = False
        self.orders = 0

    def drive(self, twist: Twist) -> None:
        self.moves = twist != REST
        self.orders += self.moves

    def stop(self) -> None:
        self.moves = False

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        return ()

    def want(self, topic: str, wanted: bool) -> None:
        return

    def close(self) -> None:
        return


class _Since:
    """A moment."""

    def __init__(self, time: float) -> None:
        self.time = time


class ExploredRobot:
    """One life of the robot side, from its start to a kill."""

    def __init__(self, kept: Content, stopped: bool) -> None:
        """`kept` is on the disk; `stopped` when STOP was pressed before the restart and not released."""
        self.now, self.kept = BEGIN, kept
        self.body = _Body()
        records = Records(kept, _Disk(), lambda: None)
        clock = self._clock
        self.station = Station(self.body, records, now=self.now, clock=clock, rng=random.Random(1))
        self.station._next_diagnostics = math.inf  # they move nothing
        self.door = StationDoor(self.station, _People())
        self.people: dict[str, Operator] = {}
        self.frozen: set[str] = set()
        self.expired: set[str] = set()
        self.count = 0
        """Of the events since the last pause: stamps differ by that."""
        self.latched = stopped
        self.pressed_by = ""
        """Who pressed STOP first since it was released; empty after a restart, which forgets it."""
        self.given = -math.inf
        """When the newest command that moved the body was given [s]."""
        self.must_rest: set[str] = set()
        """Who was obeyed and then stopped without a zero of its own: a zero of it comes before its next motion."""
        self.mover = ""
        self.held: dict[str, _Since] = {}
        """Since when who holds Release [s]."""
        self.released: _Since | None = None
        """When STOP was released last [s]."""
        for who in PEOPLE:
            self._join(who)
        self._check()
        if self.station.controls.driver is not None or self.body.moves:
            raise Violation("A robot that starts has a driver or moves.")

    def _clock(self) -> float:
        return self.now

    def _join(self, who: str) -> None:
        token = "" if who == "S" or who in self.expired else who
        operator = self.door.join(f"192.0.2.{ord(who)}:5000", token=token, secure=True)
        operator.rtt, operator.asked_time = 0.0, True
        self.people[who] = operator
        self._call(who, "/missions/get")  # each says who it is, as a handheld does

    def role(self, who: str) -> Role:
        """What `who` may do now, by this account."""
        return Role.NONE if who in self.expired else PEOPLE[who].role

    # --- what happens

    def do(self, event: str) -> None:
        """Have one of `EVENTS` happen and look whether all is as it must be; Violation when it is not."""
        who, _, what = event.partition(" ")
        if who == "wait":
            self._wait(float(what))
            return
        self.count += 1
        self._heard(who)
        before = self.body.orders
        getattr(self, f"_{what}")(who)
        if self.body.orders > before and what not in ("push", "blind"):
            raise Violation(f"{event!r} moves the body.")
        self._check()

    def _heard(self, who: str) -> None:
        self.frozen.discard(who)
        operator = self.people[who]
        operator.last_heard = operator.answered = self.now

    def _wait(self, pause: float) -> None:
        self.count = 0
        end = self.now + pause
        while self.now < end - 1e-6:
            # until the body rests it is looked at as often as the serving loop may be late
            step = SETTLE if self.body.moves or end - self.now < 1.0 else 1.0
            self.now = round(min(end, self.now + step), 6)
            for who, operator in self.people.items():
                if who not in self.frozen:
                    operator.last_heard = self.now
            self.station.step(self.now)
            self._check()
            self._check_motion()
        if self.released is not None and self.now - self.released.time > RELEASE_PAUSE + 0.05:
            self.released = None

    def _call(self, who: str, service: str) -> bool:
        return self._asked(who, service)[0]

    def _asked(self, who: str, service: str) -> tuple[bool, str]:
        """Whether it was done, and the code of the answer."""
        asked = CommandRequest(client_id=who.lower(), client_name=PEOPLE[who].name)
        try:
            answer: Any = self.door.call(self.people[who], service, asked)
        except Refused:
            return False, ""
        return getattr(answer, "success", True), getattr(answer, "code", "")

    def _publish(self, who: str, twist: Twist, stamp: float | None) -> None:
        before = self.body.orders
        try:
            self.door.publish(self.people[who], "/cmd_vel", twist, stamp)
        except Refused:
            if self.role(who) >= Role.DRIVE:
                raise Violation(f"{who} has the role and is refused.") from None
        if self.body.orders > before:
            self._judge_motion(who, self.now if stamp is None else stamp)

    def _judge_motion(self, who: str, given: float) -> None:
        """The body was just told to move by `who`."""
        if self.role(who) < Role.DRIVE:
            raise Violation(f"{who} moves the body without the role.")
        if self.latched:
            raise Violation(f"{who} moves the body while STOP is pressed.")
        if not self.station.controls.holds(self.people[who]):
            raise Violation(f"{who} moves the body without control.")
        if who in self.must_rest:
            raise Violation(f"{who} moves the body after a lapse and before a zero.")
        if self.mover not in ("", who):
            self.must_rest.add(self.mover)
        self.mover, self.given = who, given

    def _push(self, who: str) -> None:
        self._publish(who, AHEAD, self.now + self.count * 1e-6)

    def _blind(self, who: str) -> None:
        self._publish(who, AHEAD, None)

    def _late(self, who: str) -> None:
        before = self.body.orders
        self._publish(who, AHEAD, self.now - VALID_TIME - 0.2)
        if self.body.orders > before:
            raise Violation(f"A command that {who} gave long ago moves the body.")

    def _zero(self, who: str) -> None:
        self._publish(who, REST, self.now + self.count * 1e-6)
        if self.role(who) >= Role.DRIVE:
            self.must_rest.discard(who)
            if self.mover == who and not self.body.moves:
                self.mover, self.given = "", -math.inf

    def _acquire(self, who: str) -> None:
        self._control(who, "acquire")

    def _release(self, who: str) -> None:
        self._control(who, "release")

    def _request(self, who: str) -> None:
        self._control(who, "request")

    def _grant(self, who: str) -> None:
        self._control(who, "grant")

    def _object(self, who: str) -> None:
        self._control(who, "object")

    def _control(self, who: str, what: str) -> None:
        before = self.station.controls.driver
        done = self._call(who, f"/control/{what}")
        after = self.station.controls.driver
        if done and self.role(who) < Role.DRIVE:
            raise Violation(f"{who} may not {what} and is obeyed.")
        if before is not None and after is not before and before.client is not self.people[who]:
            lapsed = self.now - before.client.last_heard > CONTROL_TIMEOUT
            if not lapsed and before.client in self.people.values():
                raise Violation(f"{who} takes control from who has it by {what}.")

    def _stop(self, who: str) -> None:
        if not self._call(who, "/stop"):
            raise Violation(f"STOP of {who} is refused.")
        if not self.latched:
            self.latched, self.pressed_by = True, who
        self.held = {each: since for each, since in self.held.items() if since.time >= self.now}
        if self.body.moves:
            raise Violation("The body moves after STOP.")
        self._end_motion()

    def _hold(self, who: str) -> None:
        if self.latched and self._call(who, "/stop/hold"):
            self._holds(who)

    def _holds(self, who: str) -> None:
        """`who` was answered that its hold begins."""
        if self.role(who) < Role.DRIVE:
            raise Violation(f"{who} may not hold to release STOP and does.")
        if self.released is not None and self.now - self.released.time < RELEASE_PAUSE - 0.01:
            raise Violation(f"{who} holds to release STOP right after the last release.")
        self.held[who] = _Since(self.now)

    def _unlatch(self, who: str) -> None:
        done, code = self._asked(who, "/stop/release")
        if self.station.controls.stopped:
            if code == Code.STOP_NOT_HELD:  # for clients that know no /stop/hold that is one
                self._holds(who)
            return
        if not self.latched:
            return
        if not done or self.role(who) < Role.DRIVE:
            raise Violation(f"{who} may not release STOP and does.")
        held = self.held.get(who)
        if not (held and 0.99 <= self.now - held.time <= 5.01):
            raise Violation(f"{who} releases STOP without a hold of a second.")
        if not (self.pressed_by == who or self.station.controls.holds(self.people[who])):
            raise Violation(f"{who} releases the STOP of another without control.")
        self.latched, self.pressed_by = False, ""
        self.released = _Since(self.now)
        self.held.clear()

    def _freeze(self, who: str) -> None:
        self.frozen.add(who)

    def _cut(self, who: str) -> None:
        self.door.leave(self.people[who])
        self._ends_with(who)
        self._join(who)

    def _expire(self, who: str) -> None:
        """The role of `who` ends; its connection stays."""
        was = PEOPLE[who]
        self.expired.add(who)
        self.people[who].identity = Identity(was.id, was.name, was.role, self.now, proven=True)

    def _remove(self, who: str) -> None:
        """`who` is unpaired; its connection is there until it is cut."""
        self.expired.add(who)
        self.door.expel([PEOPLE[who].id])
        self._ends_with(who)

    # --- what must hold

    def _ends_with(self, who: str) -> None:
        if self.mover != who:
            return
        if self.body.moves:
            raise Violation(f"The body moves after {who} is gone.")
        self._end_motion()

    def _end_motion(self) -> None:
        if self.mover:
            self.must_rest.add(self.mover)
        self.mover, self.given = "", -math.inf

    def _check(self) -> None:
        controls = self.station.controls
        if controls.stopped != self.latched:
            raise Violation("STOP was undone." if self.latched else "STOP is pressed by no one.")
        if self.latched and self.body.moves:
            raise Violation("The body moves while STOP is pressed.")
        if sum(controls.holds(operator) for operator in self.people.values()) > 1:
            raise Violation("There are two drivers.")
        if not self.body.moves and self.mover:
            self._end_motion()

    def _check_motion(self) -> None:
        """The loop has looked at all that happened."""
        controls = self.station.controls
        if not self.body.moves:
            return
        if self.now - self.given > VALID_TIME + SETTLE - 0.05:
            raise Violation(f"The body moves {self.now - self.given:.2f} s after its last command.")
        if not self.mover or not controls.holds(self.people[self.mover]):
            raise Violation("The body moves and no one drives it.")


def _called(robot: ExploredRobot, connection: str) -> str:
    found = [who for who, operator in robot.people.items() if operator.id == connection]
    return f"connection of {found[0]}" if found else "a connection that is gone"


def value(robot: ExploredRobot, atom: Any, where: str) -> Any:
    """What stands for a value in the state of `robot`: times from now on, and connections by whose they are."""
    if isinstance(atom, float):
        if not abs(atom - robot.now) < 1e4:
            return round(atom, 3) if math.isfinite(atom) else NOTHING
        ahead = round(atom - robot.now, 2)
        return ("t", max(ahead, -MAX_PAST)) if ahead > 0 or where in PAST_COUNTS else NOTHING
    if isinstance(atom, str):
        return _called(robot, atom) if atom.isdigit() else atom
    if isinstance(atom, Msg):
        return repr(atom) if isinstance(atom, Twist) else type(atom).__name__
    return atom if isinstance(atom, int | bool | None) else str(atom)
