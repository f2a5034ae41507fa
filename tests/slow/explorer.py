"""The explorer: every sequence of events up to a depth, breadth first, with states merged that are the same."""

from __future__ import annotations

import random
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

from bridge.core.robot_catalogue import Operator
from robotside.autonomy.readiness import Readiness
from robotside.core.bus import Bus
from robotside.records.audit import Audit
from robotside.records.eventlog import EventLog
from robotside.records.events import Events
from robotside.services.audit_trail import AuditTrail
from robotside.station.control_status import ControlStatusPublisher
from robotside.station.remarks import Remarks
from tests.slow.explored_robot import ExploredRobot, Violation, rows, value
from tests.slow.snapshots import Living, Snapshot, Unlearned

__all__ = ["KILL", "Explorer", "Life", "Report"]

KILL = "kill"
"""The robot's computer loses its power and starts again from what is on its disk."""

IGNORED = (Audit, AuditTrail, Bus, Readiness, EventLog, Events, ControlStatusPublisher, Remarks)
"""What only tells people what happens."""

LEFT_OUT = {
    "ExploredRobot": frozenset({"now", "count", "kept"}),
    "_Body": frozenset({"orders"}),
    "CommandGate": frozenset({"dropped", "pace", "_fell", "fell_id"}),
    "Station": frozenset({"now"}),
    "Driver": frozenset({"name"}),
    "GuardedRobot": frozenset({"_wanted", "_given"}),
    "Agenda": frozenset({"*"}),
    "LimitKeeper": frozenset({"*"}),
    "SafeState": frozenset({"_held", "_lost", "_after"}),
    "_Lead": frozenset({"*"}),
    "LatencySpeedCap": frozenset({"*"}),
    "LimitViolations": frozenset({"*"}),
    "FaultGuard": frozenset({"*"}),
    "Operator": frozenset({"opened", "address", "answered"}),
}
"""Of each class what tells nothing of what can happen: counters, caches, clocks that are compared with nothing, what a body
at rest was told, and what only a task or a robot with other safe states goes by."""

WALKS, STRIDE = 100, 16
"""Random sequences, and their greatest length, by which it is learned what changes."""
LEAD = ("D stop", "D hold", "wait 1.1", "D unlatch", "D zero", "D push")
"""So half of them begin, as far as the theme has these events: few would come there by chance."""


@dataclass
class Report:
    """What was seen."""

    events: int = 0
    states: int = 1
    transitions: int = 0
    depth: int = 0
    seconds: float = 0.0
    effective: set[str] = field(default_factory=set)
    """Events that changed something somewhere before the last depth."""
    by_depth: list[int] = field(default_factory=list)
    """States that were new at each depth but the last."""

    def __str__(self) -> str:
        new = ", ".join(str(count) for count in self.by_depth)
        return (
            f"explored {self.states} states and {self.transitions} transitions of {self.events} events "
            f"to depth {self.depth} in {self.seconds:.0f} s; new states by depth: {new}"
        )


@dataclass(frozen=True, slots=True)
class _Node:
    life: Life
    saved: Snapshot
    path: tuple[str, ...]
    state: tuple[str, int]


class Life:
    """One start of the robot side, with what changes of it."""

    def __init__(self, stopped_by: str, events: Sequence[str], walks: int = WALKS) -> None:
        kept = rows()
        if stopped_by:
            kept["facts"]["stopped by"] = stopped_by
        self.robot = ExploredRobot(kept, bool(stopped_by))
        self.living = Living(self.robot, IGNORED)
        self.first = self.living.save()
        self._learn(events, walks)

    def _learn(self, events: Sequence[str], walks: int) -> None:
        """Walk at random until nothing more is found to change."""
        choice = random.Random(5)
        lead = [event for event in LEAD if event in events]
        quiet = 0
        while quiet < walks:
            quiet += 1
            walk = choice.choices(events, k=choice.randint(1, STRIDE))
            news = False
            with suppress(Violation):  # the search itself finds the shortest way to it
                for event in (*(lead if quiet % 2 else ()), *walk):
                    self.robot.do(event)
                    news = self.living.notice() or news
            if self.relearn() or news:
                quiet = 0

    def relearn(self) -> bool:
        """Whether something has changed that was not known to and so was never put back; all is as at first again."""
        found = self.living.learn()
        Living.restore(self._whole())
        self.first = self.living.save()
        return found

    def _whole(self) -> Snapshot:
        return [
            (thing, self.living._first[number])
            for number, thing in self.living._all.items()
            if self.living._first[number] is not None
        ]

    def digest(self) -> int:
        return self.living.digest(partial(value, self.robot), LEFT_OUT, (Operator,))


class Explorer:
    """Goes through all sequences of `events` and the kill."""

    def __init__(self, events: Sequence[str], walks: int = WALKS) -> None:
        """`walks` in a row must show nothing new before the search begins; what they miss has it begin again."""
        self._events, self._walks = events, walks
        self.report = Report()
        self.report.events = len(events) + 1
        self._lives: dict[str, Life] = {}
        self._seen: set[tuple[str, int]] = set()

    def run(self, depth: int, tell: Callable[[str], None] = lambda _: None) -> Report:
        """Up to `depth` events one after the other; Violation names the shortest sequence that leads to it."""
        while True:
            try:
                return self._run(depth, tell)
            except (Unlearned, Violation) as stopped:
                news = [life.relearn() for life in self._lives.values()]
                if isinstance(stopped, Violation) and not any(news):
                    raise
                self._seen.clear()  # what was merged or put back so far may have been wrong
                self.report = Report(events=self.report.events)

    def _run(self, depth: int, tell: Callable[[str], None]) -> Report:
        began = time.perf_counter()
        life = self._life("")
        Living.restore(life.first)
        frontier = [_Node(life, life.first, (), self._state(life))]
        self._note(frontier[0].state)
        for level in range(1, depth + 1):
            frontier = [node for each in frontier for node in self._beyond(each, last=level == depth)]
            self.report.depth, self.report.seconds = level, time.perf_counter() - began
            if level < depth:
                self.report.by_depth.append(self.report.states - 1 - sum(self.report.by_depth))
            news = [life.relearn() for life in self._lives.values()]
            if any(news):
                raise Unlearned("Something changes that was not learned.")
            tell(str(self.report))
        return self.report

    def _beyond(self, node: _Node, *, last: bool) -> list[_Node]:
        """The new states one event after `node`."""
        found = []
        for event in (*self._events, KILL):
            Living.restore(node.saved)
            self.report.transitions += 1
            path = (*node.path, event)
            try:
                life = self._after(node.life, event)
            except Violation as wrong:
                raise Violation(f"{wrong} After: {'; '.join(path)}.") from None
            if last:  # nothing goes on from there, so it matters to nothing whether it was seen
                continue
            state = self._state(life)
            if state != node.state:
                self.report.effective.add(event)
            if self._note(state):
                found.append(_Node(life, life.living.save(), path, state))
        return found

    def _after(self, life: Life, event: str) -> Life:
        if event != KILL:
            life.robot.do(event)
            return life
        robot = life.robot
        by = str(robot.kept["facts"].get("stopped by", ""))
        if bool(by) != robot.latched:
            raise Violation("What is on the disk of STOP is not what is pressed.")
        fresh = self._life(by)
        Living.restore(fresh.first)
        return fresh

    def _life(self, stopped_by: str) -> Life:
        if stopped_by not in self._lives:
            self._lives[stopped_by] = Life(stopped_by, self._events, self._walks)
        return self._lives[stopped_by]

    def _state(self, life: Life) -> tuple[str, int]:
        """The state that `life` is in."""
        return next(name for name, each in self._lives.items() if each is life), life.digest()

    def _note(self, state: tuple[str, int]) -> bool:
        """Whether this state was not seen yet."""
        if state in self._seen:
            return False
        self._seen.add(state)
        self.report.states = len(self._seen)
        return True
