"""Events of one robot, as the UI thread knows them: each once, those that were missed, and who acknowledged which."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, Protocol

from app.core.settings_store import Settings
from app.link.commands import Outcome
from app.link.event_order import GRAVE, KnownEvents, Missed
from bridge.msgs.arrays import Int32Array
from bridge.msgs.pilothouse_msgs import Event
from widgets.core.language import tr, trn

__all__ = ["MAX_EVENTS", "Logbook", "marks"]

MAX_EVENTS = 5000
"""Events that are kept; a robot keeps as many."""
MAX_ACKNOWLEDGED = 500
"""Events that one command acknowledges; the robot takes 1000."""
MAX_LOGS = 50
"""Logs of which it is remembered how far they are known."""
NEWS_AGE = 15.0
"""What happened longer ago is no news when it comes [s]."""
TOLD = ("control", "command")
"""Kinds of warnings that ask for nothing: who has control stands in the bar, and a refusal where it was asked."""
REMEMBERED = "events"
"""Name in the settings."""


class Send(Protocol):
    """Sends a one-shot command of `app.link.commands.COMMANDS`."""

    def __call__(self, name: str, /, **fields: Any) -> object:
        """With what it is about."""


def marks(settings: Settings) -> dict[str, int]:
    """How far each log is known from earlier days: its identity to the last number."""
    kept = settings.get(REMEMBERED, {})
    if not isinstance(kept, dict):
        return {}
    return {boot: last for boot, last in kept.items() if isinstance(last, int) and not isinstance(last, bool)}


class Logbook:
    """Events of one robot from Connect to Back, over any number of links."""

    def __init__(self, settings: Settings, send: Send) -> None:
        """What is known is remembered in `settings`; `send` asks the robot."""
        self._settings, self._send = settings, send
        self._events: dict[tuple[str, int], Event] = {}
        self._away: Missed | None = None
        """What the last absence missed; None when nothing, or when that was looked at."""
        self._asked: set[tuple[str, int]] = set()
        self._known = KnownEvents()
        self._open: list[Event] | None = None
        """None when it must be looked through anew."""
        self._told = True
        self.listeners: list[Callable[[], object]] = []
        """Called after every change; it comes often."""

    # what it knows

    @property
    def known(self) -> KnownEvents:
        """How far the log that was heard last is known."""
        return self._known

    @property
    def events(self) -> list[Event]:
        """All that is kept here, in the order in which they came."""
        return list(self._events.values())

    @property
    def open(self) -> list[Event]:
        """Warnings and alarms of the robot's log that nobody has seen to, oldest first."""
        if self._open is None:
            boot = self._known.boot
            found = [one for one in self._events.values() if one.level in GRAVE and not one.acknowledged_by]
            self._open = [one for one in found if not boot or one.boot == boot]
        return list(self._open)

    @property
    def asking(self) -> list[Event]:
        """Of those, what asks the operator for something: that control came or went and what was refused was said where it was so."""
        return [one for one in self.open if one.level == "alarm" or one.kind not in TOLD]

    @property
    def alarms(self) -> int:
        """How many alarms nobody has seen to."""
        return sum(one.level == "alarm" for one in self.open)

    @property
    def missed(self) -> list[Event]:
        """What happened while this handheld was away the last time, until that was looked at; nothing that came live."""
        return [one for one in self._events.values() if self.was_missed(one)]

    @property
    def words(self) -> str:
        """What was missed, in a few words, as in `23 while you were away`; empty when nothing was."""
        count = len(self.missed)
        if not count:
            return ""
        words = tr("{count} and more while you were away") if self.gone else tr("{count} while you were away")
        return words.format(count=count)

    def news(self) -> str:
        """What was missed, in a sentence, where it was not told by this before; else empty."""
        told, self._told = self._told, True
        if told:
            return ""
        missed = self.missed
        grave = sum(one.level in GRAVE and not one.acknowledged_by for one in missed)
        happened = trn("{count} event while you were away", "{count} events while you were away", len(missed))
        seen = tr(", {grave} to be seen to").format(grave=grave) if grave else ""
        gone = tr("; the robot keeps no more of them") if self.gone else ""
        return f"{happened}{seen}{gone}." if missed else ""

    @property
    def gone(self) -> bool:
        """Of what was missed the robot does not keep the oldest any more."""
        return self._away is not None and self._away.gone

    def was_missed(self, event: Event) -> bool:
        """Whether it happened while this handheld was away the last time."""
        away = self._away
        if away is None or event.boot != away.boot:
            return False
        return away.after < event.id <= away.until and event.id not in away.live

    def is_asked(self, event: Event) -> bool:
        """Whether the robot was asked to note that it has been seen to, and has not answered."""
        return (event.boot, event.id) in self._asked

    @staticmethod
    def is_news(event: Event, clock: float) -> bool:
        """Whether it has just happened, by the operators' `clock` [s], NaN for unknown; an acknowledgement is none."""
        stamp = event.stamp.seconds
        return not event.acknowledged_by and not (stamp > 0 and clock - stamp > NEWS_AGE)

    # what comes in

    def add(self, event: Event) -> bool:
        """Keep an event; False when that is no news."""
        key = event.boot, event.id
        before = self._events.get(key)
        if before is not None and (before.acknowledged_by or not event.acknowledged_by):
            return False
        self._events[key] = event
        self._open = None
        if event.acknowledged_by:
            self._asked.discard(key)
        while len(self._events) > MAX_EVENTS:
            del self._events[next(iter(self._events))]
        self._notify()
        return True

    def miss(self, missed: Missed) -> None:
        """So much was missed; the events themselves have come. An earlier absence does not count any more."""
        self._away, self._told = missed, False
        self._notify()

    def know(self, known: KnownEvents) -> None:
        """Remember how far the log is known, over the app's end."""
        self._known, self._open = known, None if known.boot != self._known.boot else self._open
        if known.boot:
            kept = {boot: last for boot, last in marks(self._settings).items() if boot != known.boot}
            newest = dict([*kept.items(), (known.boot, known.last)][-MAX_LOGS:])
            self._settings.set(REMEMBERED, newest)

    def answered(self, outcome: Outcome) -> None:
        """What became of an acknowledgement; the robot tells of each event that it noted by itself."""
        if outcome.name == "acknowledge" and outcome.phase in ("refused", "no_reply"):
            boot = self._known.boot
            self._asked -= {(boot, number) for number in outcome.fields["ids"]}
            self._notify()

    def dropped(self) -> None:
        """The link is another one now: what was under way has no answer."""
        self._asked.clear()
        self._notify()

    # what a finger does

    def acknowledge(self, events: Iterable[Event]) -> None:
        """Tell the robot that these have been seen to; those that somebody saw to already are left out."""
        boot = self._known.boot
        wanted = [one for one in events if not one.acknowledged_by and not self.is_asked(one)]
        numbers = [one.id for one in wanted if not boot or one.boot == boot]
        self._asked |= {(one.boot, one.id) for one in wanted}
        for start in range(0, len(numbers), MAX_ACKNOWLEDGED):
            self._send("acknowledge", ids=Int32Array(numbers[start : start + MAX_ACKNOWLEDGED]))
        self._notify()

    def clear_missed(self) -> None:
        """The operator has looked at the events that were missed."""
        if self._away is not None:
            self._away, self._told = None, True
            self._notify()

    def _notify(self) -> None:
        for listener in list(self.listeners):
            listener()
