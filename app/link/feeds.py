"""The newest message of each topic, how old it is and whether that is still believable.

`Mailbox` carries messages from the network thread to the UI thread; `Feeds` lives in the UI thread.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from bridge.core.topics import TOPICS, Topic
from bridge.msgs import Msg

__all__ = ["Feed", "Feeds", "Mailbox", "Post"]

STALE_PERIODS = 10
"""A stream is stale when this many of its periods pass in silence."""
MIN_STALE_DELAY, MAX_STALE_DELAY = 0.5, 3.0
"""Bounds of that silence [s]: jitter of a fast stream is no failure, and a slow one is not forgiven for long."""
GAPS = 3
"""A stream whose rate nobody knows is stale after so many times the last pause between two messages, or more."""
REPEAT_WINDOW = 1.0
"""What is said once may come more than once to who has just subscribed, within this [s]."""
RATE_WINDOW = 1.0
"""Length over which a stream's rate is measured [s]."""


@dataclass(frozen=True, slots=True)
class Post:
    """What the mailbox holds of one channel."""

    value: Any
    received: float
    """When the newest came [s], our clock."""
    count: int
    """How many came since the last drain, this one included."""


class Mailbox:
    """Takes values in from any thread and hands them out in one: newest wins, but queued ones all arrive."""

    def __init__(self, wake: Callable[[], object]) -> None:
        """`wake` is called after what is queued or urgent, in the posting thread; it has to bring about a `drain`.

        What is neither waits for the next regular `drain`: the glass shows no more than its frames.
        """
        self._wake = wake
        self._lock = threading.Lock()
        self._box: dict[str, Post] = {}
        self._queue: deque[tuple[str, Post]] = deque()

    def post(self, channel: str, value: Any, received: float, *, urgent: bool = False) -> None:
        """Put `value` in place of the one that waits in `channel`."""
        with self._lock:
            waiting = self._box.get(channel)
            self._box[channel] = Post(value, received, waiting.count + 1 if waiting else 1)
        if urgent:
            self._wake()

    def queue(self, channel: str, value: Any, received: float) -> None:
        """Append `value`; nothing queued is ever dropped."""
        with self._lock:
            self._queue.append((channel, Post(value, received, 1)))
        self._wake()

    def drain(self) -> list[tuple[str, Post]]:
        """Take everything out: queued values in their order, then the newest of each channel."""
        with self._lock:
            queue, self._queue = self._queue, deque()
            box, self._box = self._box, {}
        return [*queue, *box.items()]


class Feed:
    """The newest message of one topic."""

    def __init__(self, topic: Topic, *, learns: bool = False) -> None:
        """`learns`: nobody knows the topic's rate, so that what comes tells it, and one message alone was said once."""
        self.topic = topic
        self.learns = learns
        self.message: Msg | None = None
        """None before the first."""
        self.received = math.nan
        """When it came [s], our clock; NaN before the first."""
        self.rate = math.nan
        """Measured messages a second [Hz]; NaN until known."""
        self._since = math.nan
        self._count = 0
        self._gap = self._first = math.nan

    def subscribed_anew(self) -> None:
        """What was said once is said once more to whoever subscribes: that makes no stream of it."""
        self._first = math.nan

    @property
    def repeats(self) -> bool:
        """It is a stream, as far as is known, and not said once or only on change."""
        return not math.isnan(self._gap) if self.learns else self.topic.rate > 0

    @property
    def patience(self) -> float:
        """Silence after which the message is no longer believed [s]; infinite where nothing is repeated."""
        if not self.repeats:
            return math.inf
        if self.learns:
            return max(MAX_STALE_DELAY, GAPS * self._gap)
        return min(max(STALE_PERIODS / self.topic.rate, MIN_STALE_DELAY), MAX_STALE_DELAY)

    def put(self, message: Msg, received: float, count: int = 1) -> None:
        """Replace the message; `count` came since the last `put`."""
        if math.isnan(self._first):
            self._first = received
        elif received - self._first > REPEAT_WINDOW:
            self._gap = (received - self.received) / count
        if math.isnan(self._since) or received - self._since > MAX_STALE_DELAY:
            self._since, self._count, self.rate = received, 0, math.nan
        else:
            self._count += count
        if received - self._since >= RATE_WINDOW:
            self.rate = self._count / (received - self._since)
            self._since, self._count = received, 0
        self.message, self.received = message, received

    def age(self, now: float, lost_at: float = math.nan) -> float:
        """How long the message may have been untrue [s]; NaN before the first.

        A stream's age counts from its last message. What is sent only on change stays true while the
        link is up, and ages from `lost_at`, the moment the link was lost [s] (NaN while it is up).
        """
        if self.message is None:
            return math.nan
        if self.repeats:
            return max(0.0, now - self.received)
        return 0.0 if math.isnan(lost_at) else max(0.0, now - lost_at)

    def state(self, now: float, lost_at: float = math.nan) -> str:
        """`never`, `live` or `stale`."""
        if self.message is None:
            return "never"
        silent = now - self.received > self.patience
        return "stale" if silent or not math.isnan(lost_at) else "live"


class Feeds:
    """All feeds of one robot."""

    def __init__(self, now: Callable[[], float], topics: Iterable[Topic] = TOPICS) -> None:
        """`now` is our clock [s], the one that `received` is told by."""
        self._now = now
        self._feeds = {entry.name: Feed(entry) for entry in topics}
        self.lost_at = now()
        """When the link was lost [s]; NaN while it is up."""

    def __getitem__(self, name: str) -> Feed:
        """The feed of a topic; KeyError when the table has no such topic."""
        return self._feeds[name]

    def __contains__(self, name: str) -> bool:
        return name in self._feeds

    def link(self, up: bool) -> None:
        """Say whether the link stands; while it does not, everything is stale."""
        if up:
            self.lost_at = math.nan
        elif math.isnan(self.lost_at):
            self.lost_at = self._now()

    def put(self, name: str, post: Post) -> None:
        """Take in the newest message of a topic."""
        self._feeds[name].put(post.value, post.received, post.count)

    def latest(self, name: str) -> Any:
        """The newest message of a topic, however old; None before the first."""
        return self._feeds[name].message

    def age(self, name: str) -> float:
        """Age of a topic's message [s]; NaN before the first."""
        return self._feeds[name].age(self._now(), self.lost_at)

    def state(self, name: str) -> str:
        """`never`, `live` or `stale`."""
        return self._feeds[name].state(self._now(), self.lost_at)

    def forget(self) -> None:
        """Empty every feed: the next robot's messages are not this one's."""
        self._feeds = {name: Feed(feed.topic) for name, feed in self._feeds.items()}
        self.lost_at = self._now()
