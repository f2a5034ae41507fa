"""Puts the events that came live and those that were missed into one order, each once, and none left out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from bridge.msgs.arrays import Int32Array
from bridge.msgs.pilothouse_msgs import Event, GetEventsRequest, GetEventsResponse

__all__ = ["FIRST_LIMIT", "PART_LIMIT", "GRAVE", "EventStream", "KnownEvents", "Missed"]

FIRST_LIMIT = 500
"""Events that are asked for by who knows none of a robot's."""
PART_LIMIT = 250
"""Events in one answer: more would hold up what comes behind them on a slow link."""
MAX_OPEN = 500
"""Events that are asked after whether somebody has seen to them."""
GRAVE = ("warn", "alarm")
"""Levels of what somebody has to see to."""


@dataclass(frozen=True, slots=True)
class KnownEvents:
    """How far one log is known."""

    boot: str = ""
    """Identity of the log; empty when none is known."""
    last: int = 0
    """Everything up to this number is known."""
    open: tuple[int, ...] = ()
    """Those that somebody should see to and, as far as is known, nobody has."""


@dataclass(frozen=True, slots=True)
class Missed:
    """What happened while nobody listened here."""

    boot: str
    after: int
    """The last number that was known."""
    until: int
    """The last number that was requested."""
    gone: bool = False
    """The robot does not keep the oldest of them any more."""
    live: frozenset[int] = frozenset()
    """Numbers in between that came by themselves all the same."""


class EventStream:
    """Events of one robot over any number of reconnects and restarts of either side.

    After connecting: `start`, then for as long as it is `behind` what `request` says goes to the robot, and
    `answered` or `no_answer` comes back; `without_store` when there is nobody to ask. `live` at any time.
    """

    def __init__(
        self,
        tell: Callable[[Event], None],
        missed: Callable[[Missed], None] = lambda _: None,
        *,
        known: KnownEvents | None = None,
        marks: Mapping[str, int] | None = None,
    ) -> None:
        """`tell` gets each event once, oldest first, and once more when somebody has seen to it.

        `missed` is told when all that was missed has been told. `known` is how far this robot's log is known
        from before, `marks` the same of any log by its identity, where it is not known which one will answer.
        """
        known = known or KnownEvents()
        self._tell, self._missed, self._marks = tell, missed, dict(marks or {})
        self._boot, self._last = known.boot, known.last
        self._open = dict.fromkeys(known.open)
        self._ahead: set[int] = set()
        """Told already, though not everything before them."""
        self._held: list[Event] | None = None
        """Live ones that wait for the answer; None when they need not."""
        self._from: int | None = None
        """What comes after this number was missed; None when nothing was."""
        self._gone = False
        self._live: set[tuple[str, int]] = set()
        """What came by itself while something was behind: log and number."""
        self._stored = True
        self.behind = False
        """There are events to ask the robot for."""

    @property
    def known(self) -> KnownEvents:
        """Everything up to where it has been told; empty before the first answer."""
        return KnownEvents(self._boot, self._last, tuple(self._open))

    def start(self) -> None:
        """A link was made: everything since the last one is missing. Live events wait for the first answer."""
        self._held, self._stored, self.behind = [], True, True
        if self._boot and self._from is None:
            self._from, self._gone = self._last, False
            self._live.clear()

    def request(self) -> GetEventsRequest:
        """What to ask the robot now."""
        if not self._boot:
            return GetEventsRequest(most=FIRST_LIMIT)
        open = Int32Array(list(self._open)[-MAX_OPEN:])
        return GetEventsRequest(since=self._last, boot=self._boot, open=open, most=PART_LIMIT)

    def answered(self, answer: GetEventsResponse) -> None:
        """The answer to `request` came."""
        events, before = answer.events, (self._boot, self._last)
        if not self._boot and events and self._meet(events):
            return
        for event in events:
            if event.boot != self._boot:
                self._begin(event.boot)
            self._take(event)
        if self._from is not None:
            self._gone = self._gone or answer.oldest > self._from + 1
        if not answer.more or before == (self._boot, self._last):
            self._catch_up()

    def no_answer(self) -> None:
        """None came: live events go on, and what lies before them is asked for again."""
        held, self._held = self._held or [], None
        for event in held:
            self._take_live(event)

    def without_store(self) -> None:
        """The robot keeps no events: go on with what comes live."""
        self._stored = self.behind = False
        self.no_answer()

    def live(self, event: Event) -> None:
        """An event came by itself."""
        if self.behind:
            self._live.add((event.boot, event.id))
        if self._held is not None:
            self._held.append(event)
        else:
            self._take_live(event)

    def _meet(self, newest: list[Event]) -> bool:
        """Learn which log it is. True when it has to be asked anew, from where it is known from an earlier day."""
        self._boot = newest[-1].boot
        mark = self._marks.get(self._boot)
        if mark is None:
            self._last = newest[0].id - 1
            return False
        self._from, self._gone = mark, False
        old = newest[0].id > mark + 1
        self._last = mark if old else newest[0].id - 1
        return old

    def _begin(self, boot: str) -> None:
        """Another log began: nothing of it is known."""
        if self._from is not None:
            self._from, self._gone = 0, False
        self._boot, self._last = boot, 0
        self._ahead.clear()
        self._open.clear()

    def _take(self, event: Event) -> None:
        """One that was requested."""
        if event.id <= self._last:
            self._say_again(event)
            return
        self._last = event.id
        if event.id in self._ahead:
            self._ahead.discard(event.id)
            self._say_again(event)
        else:
            self._say(event)

    def _catch_up(self) -> None:
        self.behind = False
        if self._from is not None and self._last > self._from:
            here = {number for boot, number in self._live if boot == self._boot}
            live = frozenset(number for number in here if self._from < number <= self._last)
            if len(live) < self._last - self._from:
                self._missed(Missed(self._boot, self._from, self._last, self._gone, live))
        self._from = None
        self._live.clear()
        self._last = max(self._last, *self._ahead, 0)
        self._ahead.clear()
        self.no_answer()

    def _take_live(self, event: Event) -> None:
        if event.boot != self._boot and (self._boot or not self.behind):
            self._begin(event.boot)
        if event.id in self._ahead or (self._boot and event.id <= self._last):
            self._say_again(event)
            return
        if self._stored and self._last and event.id > self._last + 1:
            self.behind = True  # one in between was lost on its way
        if self.behind:
            self._ahead.add(event.id)
        else:
            self._last = event.id
        self._say(event)

    def _say(self, event: Event) -> None:
        if event.level in GRAVE and not event.acknowledged_by:
            self._open[event.id] = None
        self._tell(event)

    def _say_again(self, event: Event) -> None:
        """Known already; that somebody has seen to it is news."""
        if event.acknowledged_by:
            self._open.pop(event.id, None)
            self._tell(event)
