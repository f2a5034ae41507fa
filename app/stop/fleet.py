"""STOP ALL: every robot that is known is stopped at once, each over a lane of its own, and it is told how many are.

The connected robot is stopped by its own link, ahead of everything here. `Fleet` lives in the UI thread. A robot that is
paired counts as stopped only where it proved its key.
"""

from __future__ import annotations

import math
import time
import uuid
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Protocol

from app.discovery.known_robots import Entry
from app.stop.fleet_lanes import FleetLanes, Lane, Meant, stop_lane
from app.stop.robot_count import count
from app.stop.same_robot import Row, SameRobots, Seen
from app.stop.stop_state import ANSWER_TIMEOUT, UNCONFIRMED, silence
from bridge.client.credentials import Credentials
from bridge.msgs.pilothouse_msgs import ControlStatus, RobotInfo
from bridge.msgs.std_msgs import Time
from widgets.core.language import tr

if TYPE_CHECKING:
    from app.stop.stop_lane import Report  # when STOP ALL is pressed, for a quick start

__all__ = ["MAX_ROBOTS", "Connected", "Fleet", "Row"]

MAX_ROBOTS = 100
"""So many robots are stopped at once at most; those that are connected, saved or paired come on top."""
HEAD_START = 0.02
"""So long the connected robot's own STOP has the computer to itself [s]."""
HEARD = 3.0
"""A robot that said HELLO within this is there [s]; how long ago it was is told of others."""


class Identity(Protocol):
    """Who the connected robot is."""

    url: str

    @property
    def name(self) -> str:
        """Its name, else its address."""

    @property
    def info(self) -> RobotInfo:
        """Its newest `/robot/info`; all fields empty before the first."""

    @property
    def foreign(self) -> bool:
        """It is known to have no STOP of its own."""


class StopReport(Protocol):
    """STOP of the connected robot."""

    @property
    def phase(self) -> str:
        """As of `stop_state.Verdict`; `ready` when it was released."""

    @property
    def sentence(self) -> str:
        """The same for the operator; empty where the phase says it all."""

    @property
    def owed(self) -> bool:
        """It was pressed here, and has to be sent on by whoever leaves the robot now."""


class Connected(Protocol):
    """The session with the connected robot, as far as STOP ALL needs it."""

    @property
    def link(self) -> object:
        """What carries it to the robot; another one after the app was put away."""

    @property
    def connected(self) -> bool:
        """The link stands."""

    @property
    def ever_connected(self) -> bool:
        """A robot has answered there: the address is no slip of the pen."""

    @property
    def robot(self) -> Identity:
        """Who it is."""

    @property
    def robot_stop(self) -> StopReport:
        """Its STOP."""

    @property
    def boot(self) -> str:
        """Alike for one robot under two addresses; empty while it is not known."""

    @property
    def control_status(self) -> ControlStatus | None:
        """Its newest word of control; None before the first."""

    @property
    def fingerprint(self) -> str:
        """Of the certificate that it has shown over its link; empty without one."""

    def stop(self) -> None:
        """STOP, over its own lane."""


class Fleet:
    """Who is being stopped, and what became of it."""

    def __init__(
        self,
        *,
        client_id: str,
        client_name: str,
        now: Callable[[], float] = time.monotonic,
        new_id: Callable[[], str] = lambda: uuid.uuid4().hex,
        open_lane: Callable[..., Lane] | None = None,
        credentials: Callable[[str, str], Credentials | None] = lambda _url, _key: None,
        most: int = MAX_ROBOTS,
    ) -> None:
        """`now` is our clock [s]; `most` is how many robots are stopped at once that nobody saved, paired or connected to.

        `credentials(url, key)` are those for the paired robot that is expected at an address, where `key` is what its HELLO
        claims as in `Entry`; None where none is.
        """
        self._lanes = FleetLanes(
            open_lane
            or partial(stop_lane, now=now, new_id=new_id, client_id=client_id, client_name=client_name)
        )
        self._most, self._now, self._credentials = most, now, credentials
        self._robots: dict[str, Meant] = {}
        self._linked = ""
        """Address of the one that its own link stops; empty for none."""
        self._same = SameRobots()
        self.untried = 0
        """Robots that were too many."""
        self.rows: list[Row] = []
        """One for each robot that was ever met, in the order in which they were listed."""
        self.unmet = 0
        """Addresses that STOP is sent to and where nothing was ever met: they are not counted as robots."""

    # what the UI thread calls

    @property
    def active(self) -> bool:
        """STOP ALL was pressed, or a robot was left before it confirmed its STOP, and that was not let go."""
        return bool(self._robots)

    @property
    def meant_all(self) -> bool:
        """STOP ALL was pressed, and not the STOP of single robots alone that were left then."""
        return any(robot.left is None for robot in self._robots.values())

    @property
    def stopped(self) -> int:
        """So many robots say that they are stopped and rest."""
        return sum(row.phase == "stopped" for row in self.rows)

    @property
    def total(self) -> int:
        """So many robots there are, those included that were too many to be tried."""
        return len(self.rows) + self.untried

    @property
    def sending(self) -> bool:
        """Something is still sent: a robot has not confirmed, or has no STOP and is held by zero speed."""
        return any(row.foreign or row.phase not in ("stopped", "released") for row in self.rows)

    def press(self, entries: Iterable[Entry], connected: Connected | None = None) -> None:
        """STOP to all of `entries` and to who was meant before; the one that is connected first, by its own link.

        `entries` are looked at after that.
        """
        if connected is not None:
            connected.stop()
            time.sleep(0)  # lets the network thread send it before anything is done here
            self._linked = connected.robot.url
            self._robot(connected.robot.url, "", connected.robot.name).begun = False
            self._meet(connected)
        for entry in self._chosen(list(entries)):
            self._add(entry)
        for robot in self._robots.values():
            robot.left = None
        others = [robot for robot in self._robots.values() if robot.url != self._linked]
        self._lanes.press(others, 0.0 if connected is None else HEAD_START)
        self.update(connected)

    def leave(self, connected: Connected) -> bool:
        """The robot is about to be left, or the app to be put away: a STOP that it has not confirmed is sent on over a lane.

        Returns whether it is. Who opens the robot again stops it over the new link as soon as that stands, which alone can release it.
        """
        self.update(connected)
        url, owed = connected.robot.url, connected.robot_stop.owed
        if owed and url != self._linked:
            alone = url not in self._robots or self._robots[url].left is not None
            robot = self._robot(url, "", connected.robot.name)
            self._meet(connected)
            robot.left = connected.link if alone else None
            self._lanes.press([robot])
        self.update(None)
        return owed

    def update(self, connected: Connected | None) -> None:
        """Bring `rows` up to date. A robot that is connected no longer is stopped by a lane of its own from now on.

        One that has no STOP and was connected meanwhile is held by its link instead, which alone can let it go.
        """
        if connected is not None:
            self._give_back(connected)
            self._meet(connected)
        if not self.active:
            self.rows, self.unmet = [], 0
            return
        url = "" if connected is None else connected.robot.url
        if self._linked and self._linked != url:
            self._take_over(self._robots[self._linked])
        if connected is not None and self._linked != url and _is_for_link(self._robots.get(url), connected):
            connected.stop()
            self._lanes.close_lane(self._robots[url])
            self._linked = url
        seen = [(robot, self._seen(robot, connected)) for robot in self._robots.values()]
        self.rows = self._same.counted([one for robot, one in seen if robot.met])
        self.unmet = sum(not robot.met for robot in self._robots.values())

    def since(self, entries: Iterable[Entry]) -> int:
        """How many of `entries` STOP ALL was not meant for: they came after it was pressed."""
        boots = {robot.boot_by_link for robot in self._robots.values() if robot.boot_by_link}
        fresh = [one for one in entries if one.url not in self._robots and one.boot not in boots]
        robots = count(fresh, None).robots
        return robots - self.untried if self.meant_all and len(fresh) > self.untried else 0

    def let_go(self) -> None:
        """Send nothing any more. Robots with a STOP of their own stay stopped; the others may be driven again."""
        for robot in self._robots.values():
            self._lanes.close_lane(robot)
        self._robots, self._linked, self.untried, self.rows = {}, "", 0, []
        self._same.forget()

    def close(self) -> None:
        """Let go, and end the network thread; a STOP that was pressed just now has a moment to get through."""
        until = self._now() + ANSWER_TIMEOUT
        while any(row.phase == "sent" for row in self.rows) and self._now() < until:
            time.sleep(0.01)
            self.update(None)
        self.let_go()
        self._lanes.close()

    # who is meant

    def _chosen(self, entries: list[Entry]) -> list[Entry]:
        """Those that are tried: saved, paired and connected ones, then who is known for longest; the rest are counted."""
        strangers = [one for one in entries if one.url not in self._robots and not (one.kept or one.saved)]
        kept = {one.url for one in entries if one.kept or one.saved} - self._robots.keys()
        room = max(0, self._most - len(self._robots) - len(kept))
        left_out = {one.url for one in sorted(strangers, key=lambda one: -one.known_for)[room:]}
        self.untried = len(left_out)
        return [one for one in entries if one.url not in left_out]

    def _add(self, entry: Entry) -> None:
        robot = self._robot(entry.url, entry.key, "")
        robot.name, robot.boot = entry.name or entry.address, entry.boot or robot.boot
        robot.met = robot.met or entry.met
        robot.heard = "" if entry.silent <= HEARD else _not_heard(entry.silent)

    def _robot(self, url: str, key: str, name: str) -> Meant:
        robot = self._robots.setdefault(url, Meant(url, name, ""))
        if robot.credentials is None and robot.lane is None:
            robot.credentials = self._credentials(url, key)
        robot.met = robot.met or robot.credentials is not None
        return robot

    def _meet(self, connected: Connected) -> None:
        """Who answered over a link is a robot, whatever becomes of the link."""
        robot = self._robots.get(connected.robot.url)
        if robot is not None:
            robot.met = robot.met or connected.ever_connected

    def _take_over(self, robot: Meant) -> None:
        """Its link is gone: a lane goes on, unless STOP was released over the link."""
        self._linked = ""
        if robot.last is None or robot.last.phase != "released":
            self._lanes.press([robot])

    def _give_back(self, connected: Connected) -> None:
        """A robot that was left is there again: its new link stops it from now on, for two would not agree on its release."""
        robot = self._robots.get(connected.robot.url)
        if robot is None or robot.left in (None, connected.link) or not connected.connected:
            return
        row = self._seen(robot, None).row
        if row.foreign and not connected.robot.foreign:
            return  # its link does not know yet that it has to hold it
        if row.foreign or row.phase in UNCONFIRMED:
            connected.stop()
        self._lanes.close_lane(self._robots.pop(robot.url))

    # what is known

    def _seen(self, robot: Meant, connected: Connected | None) -> Seen:
        """What is known at one address; a paired robot is known there only as far as its key was proved."""
        from app.stop.stop_lane import Report

        lane = robot.lane  # once: the network thread takes it away
        report = lane.report if lane is not None else Report("sent")
        robot.met = robot.met or report.reached
        if connected is not None and robot.url == self._linked:
            robot.boot_by_link = connected.boot or robot.boot_by_link
            robot.proven_by_link = connected.fingerprint
            row, proven, identity = (
                self._linked_row(robot, connected),
                connected.fingerprint,
                _identity(connected),
            )
        elif lane is None and robot.last is not None:
            row, proven, identity = robot.last, robot.proven_by_link, None
        else:
            row, proven, identity = _lane_row(robot, report), report.proven, report.identity
        key = "" if robot.credentials is None else robot.credentials.fingerprint
        if key and proven != key:
            return Seen(_unproven(row))
        return Seen(row, key, (robot.boot_by_link or robot.boot, identity))

    def _linked_row(self, robot: Meant, connected: Connected) -> Row:
        robot.begun = robot.begun or connected.robot_stop.phase != "ready"
        robot.last = _linked_row(connected, begun=robot.begun)
        return robot.last


def _is_for_link(robot: Meant | None, connected: Connected) -> bool:
    """STOP ALL was meant for it, and it has no STOP: only its link can hold it and let it go."""
    return robot is not None and robot.left is None and connected.robot.foreign


def _not_heard(silent: float) -> str:
    return (
        tr("Never heard here.")
        if math.isnan(silent)
        else tr("Not heard for {silent}.").format(silent=silence(silent))
    )


def _lane_row(robot: Meant, report: Report) -> Row:
    sentence = report.sentence
    if robot.heard and not report.reached:
        sentence = f"{robot.heard} {sentence}".strip()
    return Row(robot.url, robot.name or report.name, report.phase, sentence, report.foreign)


def _unproven(row: Row) -> Row:
    """What is said at the address of a paired robot by one that has not proved to be it."""
    if row.phase not in ("stopped", "released", "moves"):
        return row
    return replace(row, phase="no_answer", sentence=tr("It has not proved to be your paired robot."))


def _identity(connected: Connected) -> tuple[str, str, Time] | None:
    status, info = connected.control_status, connected.robot.info
    if status is None or not info.name or status.stamp == Time():
        return None
    return info.name, info.model, status.stamp


def _linked_row(connected: Connected, *, begun: bool) -> Row:
    phase, sentence = connected.robot_stop.phase, connected.robot_stop.sentence
    if phase == "ready":
        phase, sentence = ("released", tr("STOP was released.")) if begun else ("sent", "")
    return Row(
        connected.robot.url,
        connected.robot.name,
        phase,
        sentence,
        connected.robot.foreign and phase != "released",
    )
