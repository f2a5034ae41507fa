"""The newest message of every topic at any moment of a recording, found in a thread of its own.

What is kept of it is a few pieces, and a bounded part of the memory, however long the recording is and however well it is packed.
"""

from __future__ import annotations

import bisect
import logging
import math
import threading
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass

from app.core.newest_worker import NewestWorker
from app.replay.recording_file import Record, RecordingFile
from app.replay.recording_index import Index, Topic
from bridge.msgs import Msg

__all__ = ["Playback"]

log = logging.getLogger(__name__)

MAX_PIECES = 6
"""Pieces that are kept unpacked."""
MAX_KEPT = 96 * 2**20
"""What they may take together [byte]; the one that is read now is kept whatever it takes."""
RECORD_SIZE = 150
"""What a message takes besides its text, roughly [byte]."""


@dataclass(slots=True)
class _Held:
    """The message of a topic that was told last, and how long it stays the newest."""

    since: float
    until: float


class Playback:
    """Tells `deliver(topic, message, time)` what is new at the moments that it is asked for; newest wins."""

    def __init__(
        self,
        index: Index,
        deliver: Callable[[str, Msg, float], object],
        failed: Callable[[Exception], object] = lambda _: None,
    ) -> None:
        """`deliver` is called in the thread that reads, and so is `failed` where that cannot go on."""
        self._index, self._deliver, self._failed = index, deliver, failed
        self._lock = threading.Lock()
        """Held while the file is read."""
        self._closed = False
        self._file: RecordingFile | None = None
        self._pieces: OrderedDict[int, dict[str, list[Record]]] = OrderedDict()
        self._sizes: dict[int, int] = {}
        """What each of them takes [byte]."""
        self._held: dict[str, _Held] = {}
        self._worker: NewestWorker[tuple[float, int]] = NewestWorker(self._work, "playback")
        self._run = self._told_run = 0

    def ask(self, at: float, *, anew: bool = False) -> None:
        """Have what is new at `at` [s since 1970] delivered; `anew` has all of it told once more."""
        self._run += anew
        self._worker.put((at, self._run))

    def close(self) -> None:
        """Tell nothing any more. Nothing is waited for, which would hold up fingers: who reads the file lets go of it."""
        self._closed = True
        self._worker.drop()
        self._let_go()

    def _let_go(self) -> None:
        """Close the file, unless it is being read."""
        if self._lock.acquire(blocking=False):
            try:
                if self._file is not None:
                    self._file.close()
                    self._file = None
                self._pieces.clear()
                self._sizes.clear()
            finally:
                self._lock.release()

    def _work(self, wish: tuple[float, int]) -> None:
        at, run = wish
        if run != self._told_run:  # that wish itself may have been skipped for a newer one
            self._told_run = run
            self._held.clear()
        try:
            with self._lock:
                self.tell(at)
        except Exception as fault:  # a thread that ends silently would be playing for ever
            log.exception("the recording cannot be read")
            if not self._closed:
                self._failed(fault)
        if self._closed:
            self._let_go()

    def tell(self, at: float) -> None:
        """Deliver of each topic the newest message at `at` [s since 1970] that was not told last.

        OSError or RecordingError where the file is gone, or another one.
        """
        for topic in self._index.topics.values():
            if self._closed:
                return
            held = self._held.get(topic.name)
            if topic.type is None or (held is not None and held.since <= at < held.until):
                continue
            self._tell_topic(topic, at)

    def _tell_topic(self, topic: Topic, at: float) -> None:
        stretches = self._index.stretches
        later = math.inf
        for number in reversed(topic.stretches):
            if stretches[number].first > at:
                later = stretches[number].first
                continue
            records = self._piece(number).get(topic.name, [])
            place = bisect.bisect_right(records, at, key=lambda one: one.time)
            if place < len(records):
                later = min(later, records[place].time)
            if place:
                record = records[place - 1]
                self._held[topic.name] = _Held(record.time, later)
                message = record.message()
                if message is not None:
                    self._deliver(topic.name, message, record.time)
                return
        self._held[topic.name] = _Held(-math.inf, later)

    def _piece(self, number: int) -> dict[str, list[Record]]:
        """Messages of a piece by topic, in the order of their times."""
        if number in self._pieces:
            self._pieces.move_to_end(number)
            return self._pieces[number]
        if self._file is None:
            self._file = RecordingFile(self._index.path)
            self._file.channels = dict(self._index.channels)
        by_topic: dict[str, list[Record]] = {}
        for record in self._file.read(self._index.stretches[number].piece):
            by_topic.setdefault(record.channel.topic, []).append(record)
        for records in by_topic.values():
            records.sort(key=lambda one: one.time)
        size = sum(len(one.raw) + RECORD_SIZE for records in by_topic.values() for one in records)
        self._pieces[number], self._sizes[number] = by_topic, size
        while len(self._pieces) > 1 and (
            len(self._pieces) > MAX_PIECES or sum(self._sizes.values()) > MAX_KEPT
        ):
            oldest, _ = self._pieces.popitem(last=False)
            del self._sizes[oldest]
        return by_topic
