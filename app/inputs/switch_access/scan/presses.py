"""From contacts that bounce, repeat, overlap and stick to clean presses of switch A and switch B; STOP before all of them.

contacts = Contacts(Timing(), hear)
contacts.down("B", ("key", 0, 13), now)     # … up(…), and update(now) with each heartbeat

Any number of keys and buttons may be one switch: it is down while one of them is. A key that the system repeats while it is held
comes down only once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Literal, NamedTuple

__all__ = ["Contacts", "Event", "Timing"]

Switch = Literal["A", "B"]
What = Literal["down", "up", "held", "stop", "stuck", "free", "unsure"]
MAX_FRAME = 0.1
"""A frame counts for no more of a hold [s]: a switch that came up while it was drawn is only heard of after it."""
RESET_TIME = 0.15
"""A system that takes the focus away may tell that all keys came up so shortly before it [s]."""
REPEAT_TIME = 1.0
"""What was down when the focus went and comes down within so long of its return [s] is still held: the system repeats it."""
MIN_EXTRA_HOLD = 0.3
"""STOP and going back need a hold that is at least so much longer than what is accepted as a press at all [s]."""

ENDS_FIRST: tuple[Switch, ...] = ("B", "A")
"""Of two that opened at once B is over first, which was down first: else both together had been STOP."""


@dataclass(frozen=True, slots=True)
class Timing:
    """How presses are told from what is none; all in s. Figures of the accessibility world: docs/switches.md."""

    debounce: float = 0.08
    """A contact that opens for less is still closed."""
    ignore_repeat: float = 0.3
    """A press of the same switch that begins so soon after the last one began is none: a trembling hand."""
    acceptance: float = 0.0
    """A switch must be down for so long before it counts: a hand that brushes over it."""
    back: float = 0.6
    """A held so long goes back, and on going back once more after each such time."""
    stop: float = 0.8
    """B held so long is STOP."""
    stuck: float = 5.0
    """What is down for longer is stuck, and counts as up until it has been."""

    @property
    def hold_back(self) -> float:
        """A is held so long to go back [s]: no sooner than a press of it counts at all."""
        return max(self.back, self.acceptance + MIN_EXTRA_HOLD)

    @property
    def hold_stop(self) -> float:
        """B is held so long to stop [s]."""
        return max(self.stop, self.acceptance + MIN_EXTRA_HOLD)


class Event(NamedTuple):
    """What a switch has done."""

    what: What
    """`down`: pressed. `up`: that press is over. `held`: A long enough to go back, told again while it stays. `stop`: B long
    enough, or both; nothing more of that press is told. `stuck`: down for too long, nothing is told of it until `free`.
    `unsure`: B came up while a frame was drawn that took so long that nobody knows whether it was held; nothing comes of it."""
    switch: Switch
    at: float
    """When [s, monotonic]; of `down` when the contact closed, of `up` when it opened."""
    began: float
    """When the press that it belongs to began [s]."""


@dataclass(slots=True)
class _Contact:
    """One switch."""

    sources: set[Hashable] = field(default_factory=set)
    began: float = -math.inf
    opened: float = math.inf
    """When it was heard that the last of its sources came up; infinite while one is down."""
    ended: float = math.inf
    """When that was at the earliest [s]; the same but for slow frames."""
    taken: float = -math.inf
    """When the last press began that was told."""
    standing: Literal["up", "waits", "down", "void", "stuck"] = "up"
    """`waits` to be accepted; `void`: down, and nothing comes of it."""
    told: int = 0
    """How often `held` was told of this press."""

    @property
    def closed(self) -> bool:
        """It is down, or opened so shortly ago that it may be bouncing, and it is not stuck."""
        return self.standing not in ("up", "stuck")


class Contacts:
    """Both switches. `update` must be called with each heartbeat; times only grow."""

    def __init__(self, timing: Timing, hear: Callable[[Event], object]) -> None:
        """`hear` is told each event, in order."""
        self.timing, self._hear = timing, hear
        self._contacts: dict[Switch, _Contact] = {"A": _Contact(), "B": _Contact()}
        self._frames = (math.nan, math.nan)
        """The two last looks [s]: what is heard now has happened since the first of them."""
        self._seen: dict[Hashable, float] = {}
        """When each source was last heard to come up [s]."""
        self._held_over: set[Hashable] = set()
        """Sources that were down when the focus went."""
        self._repeats_until = -math.inf

    def is_closed(self, switch: Switch) -> bool:
        """A press of it goes on, or ended so shortly ago that it may be bouncing, and it is not stuck."""
        return self._contacts[switch].closed

    def down(self, switch: Switch, source: Hashable, now: float) -> None:
        """A key or button of that switch closed; nothing where it was told so before."""
        self._judge(now)
        contact = self._contacts[switch]
        if source in contact.sources:
            return
        contact.sources.add(source)
        bounced = not math.isinf(contact.opened)
        contact.opened = contact.ended = math.inf
        other = self._contacts["A" if switch == "B" else "B"]
        both = other.closed and bool(other.sources)
        if contact.standing != "up":
            if both and bounced and contact.closed and contact.told >= 0 and other.told >= 0:
                self._stop(switch, now)
            return
        contact.began, contact.told = now, 0
        if both:
            self._stop(switch, now)
        elif now - contact.taken < self.timing.ignore_repeat or self._is_held_over(source, now):
            contact.standing = "void"
        else:
            contact.standing = "waits"
            self._judge(now)

    def up(self, switch: Switch, source: Hashable, now: float) -> None:
        """It opened; whether that is the end of the press is known after `debounce`."""
        contact = self._contacts[switch]
        if source in contact.sources:
            contact.sources.discard(source)
            self._seen[source] = now
            self._held_over.discard(source)
            if not contact.sources:
                contact.opened, contact.ended = now, max(self._sure(now), contact.began)
        self._judge(now)

    def lost(self) -> None:
        """Nobody will tell how it goes on: both are up, and nothing comes of what was down, nor of its going on."""
        before = self._frames[1]
        for switch, contact in self._contacts.items():
            self._held_over |= contact.sources
            self._contacts[switch] = _Contact(taken=contact.taken)
        self._held_over |= {source for source, at in self._seen.items() if not at < before - RESET_TIME}
        self._seen.clear()
        self._repeats_until = math.inf

    def found(self, now: float) -> None:
        """Keys are told again."""
        if self._held_over:
            self._repeats_until = now + REPEAT_TIME

    def update(self, now: float) -> None:
        """What only time tells: accepted, held, let go, stuck."""
        self._frames = self._frames[1], now
        self._judge(now)

    def _sure(self, now: float) -> float:
        """What is heard now has happened by then at the earliest, or shortly after [s]."""
        before = self._frames[0]
        return now if math.isnan(before) else min(now, before + MAX_FRAME)

    def _is_held_over(self, source: Hashable, now: float) -> bool:
        if now >= self._repeats_until:
            self._held_over.clear()
        return source in self._held_over

    def _judge(self, now: float) -> None:
        for switch in sorted(ENDS_FIRST, key=lambda one: self._contacts[one].opened):
            self._look(switch, self._contacts[switch], now)

    def _look(self, switch: Switch, contact: _Contact, now: float) -> None:
        if contact.standing == "up":
            return
        until = max(min(self._sure(now), contact.ended), contact.began)
        counts = until - contact.began >= self.timing.acceptance
        if contact.standing == "waits" and counts and not (switch == "A" and self._b_may_be_over()):
            contact.standing, contact.taken = "down", contact.began
            self._tell("down", switch, contact.began)
        if contact.standing in ("down", "waits", "void") and contact.told >= 0:
            self._held(switch, contact, until)
        if contact.standing != "stuck" and until - contact.began >= self.timing.stuck:
            contact.standing = "stuck"
            self._tell("stuck", switch, until)
        if now - contact.opened >= self.timing.debounce:
            self._end(switch, contact)

    def _b_may_be_over(self) -> bool:
        """What B does is done before what A does next, and is known a moment after B has opened."""
        b = self._contacts["B"]
        return b.standing == "down" and not b.sources

    def _held(self, switch: Switch, contact: _Contact, until: float) -> None:
        if switch == "B":
            if until - contact.began >= self.timing.hold_stop:
                self._stop(switch, until)
            return
        while contact.standing == "down":
            at = contact.began + (contact.told + 1) * self.timing.hold_back
            if at > until:
                return
            contact.told += 1
            self._tell("held", switch, at)

    def _stop(self, switch: Switch, at: float) -> None:
        """Nothing else comes of what is down now."""
        for contact in self._contacts.values():
            if contact.closed or contact.sources:
                contact.standing = "stuck" if contact.standing == "stuck" else "void"
                contact.told = -1
        self._tell("stop", switch, at)

    def _end(self, switch: Switch, contact: _Contact) -> None:
        before, contact.standing = contact.standing, "up"
        if before == "down":
            perhaps = switch == "B" and contact.opened - contact.began >= self.timing.hold_stop
            self._tell("unsure" if perhaps else "up", switch, contact.ended)
        elif before == "stuck":
            self._tell("free", switch, contact.opened)

    def _tell(self, what: What, switch: Switch, at: float) -> None:
        self._hear(Event(what, switch, at, self._contacts[switch].began))
