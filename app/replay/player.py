"""A recording that is played: a moment of the past, its speed, and the feeds of that moment.

Nothing here knows a link: what is played can be looked at, and nothing else.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from app.core.waking import wake_trigger
from app.link.camera_decoder import PICTURE, CameraDecoder
from app.link.feeds import Feeds, Mailbox, Post
from app.replay.playback import Playback
from app.replay.recording_file import RecordingError
from app.replay.recording_index import Index, index_of, series
from app.replay.recording_list import CANNOT
from bridge.core.camera_frames import Frame
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from widgets.core.language import tr

__all__ = ["SPEEDS", "Player"]

log = logging.getLogger(__name__)

SPEEDS = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
PICTURES = "/camera/image/compressed"
_OPENED, _FAILED, _PROGRESS, _SERIES = "replay opened", "replay failed", "replay progress", "replay series"
LONG_STEP = 1.0
"""A frame that took longer [s] moves the recording on by no more: the app was away."""


class Player:
    """One recording, from when it is opened until it is closed. Everything here happens in the UI thread."""

    def __init__(self, path: Path, now: Callable[[], float]) -> None:
        """Begin to open the recording at `path`; `now` is a clock [s]."""
        self.path = path
        self.index: Index | None = None
        """None until it is open."""
        self.problem = ""
        """Why it could not be opened, as a sentence."""
        self.progress = 0.0
        """Part of it that has been read, 0 to 1."""
        self.position = math.nan
        """The moment that is shown [s since 1970]; NaN until it is open."""
        self.speed = 1.0
        self.playing = False
        self.feeds = Feeds(lambda: self.position)
        self.listeners: list[Callable[[str, Post], None]] = []
        """Called with each topic and post of the moment, and with decoded pictures."""
        self._now, self._ticked = now, now()
        self._cancelled = threading.Event()
        self._mailbox = Mailbox(wake_trigger(self.drain))
        self._camera = CameraDecoder(self._mailbox)
        self._playback: Playback | None = None
        self._jobs = ThreadPoolExecutor(1, "recording")
        self._series: dict[object, Callable[[Any], object]] = {}
        self._jobs.submit(self._open)

    # in the thread of the jobs

    def _told(self, part: float) -> bool:
        self._mailbox.post(_PROGRESS, part, 0.0)
        return self._cancelled.is_set()

    def _open(self) -> None:
        try:
            index = index_of(self.path, self._told)
            if index is not None:
                self._mailbox.queue(_OPENED, index, 0.0)
        except Exception as fault:  # noqa: BLE001 - a thread that ends silently would be reading for ever
            self._fail(fault)

    def _gather(self, index: Index, key: tuple[str, str]) -> None:
        try:
            found = series(index, *key, lambda _: self._cancelled.is_set())
        except Exception as fault:  # noqa: BLE001 - same
            found = None
            self._fail(fault)
        self._mailbox.queue(_SERIES, (key, found), 0.0)

    def _fail(self, fault: Exception) -> None:
        """Say why it cannot be read; in any thread."""
        if isinstance(fault, RecordingError):
            sentence = str(fault)
        elif isinstance(fault, OSError):
            sentence = f"{self.path.name}: {fault.strerror or fault}"
        else:
            log.error("%s cannot be read", self.path, exc_info=fault)
            sentence = tr(CANNOT).format(name=self.path.name, fault=type(fault).__name__)
        self._mailbox.queue(_FAILED, sentence, 0.0)

    # in the UI thread

    def close(self) -> None:
        """Have all threads end and the file let go of; none of that is waited for."""
        self._cancelled.set()
        self.listeners.clear()
        self._jobs.shutdown(wait=False, cancel_futures=True)  # fingers are not held up by a long file
        if self._playback is not None:
            self._playback.close()
        self._camera.close()

    def drain(self) -> None:
        """Take in what the threads have found."""
        if self._cancelled.is_set():
            return
        for channel, post in self._mailbox.drain():
            self._take(channel, post)

    def _take(self, channel: str, post: Post) -> None:
        if channel == _PROGRESS:
            self.progress = post.value
        elif channel == _FAILED:
            self.problem, self.playing = post.value, False
        elif channel == _OPENED:
            self._opened(post.value)
        elif channel == _SERIES:
            key, found = post.value
            take = self._series.pop(key, None)
            if take is not None and found is not None:
                take(found)
        elif channel == PICTURE:
            self._tell(channel, post)
        elif channel == PICTURES:
            image: CompressedImage = post.value
            self._camera.show(Frame(0, image.header.stamp.seconds, 0, 0, bytes(image.data)), post.received)
        elif post.received <= self.position:  # else the moment has been left again
            if channel in self.feeds:
                self.feeds.put(channel, post)
            self._tell(channel, post)

    def _tell(self, channel: str, post: Post) -> None:
        for listener in list(self.listeners):
            listener(channel, post)

    def _opened(self, index: Index) -> None:
        self.index, self.progress = index, 1.0
        self.feeds.link(True)
        self._playback = Playback(index, self._deliver, self._fail)
        self.seek(index.start)

    def _deliver(self, topic: str, message: Msg, at: float) -> None:
        """In the thread that reads."""
        self._mailbox.post(topic, message, at, urgent=True)

    def tick(self) -> None:
        """Go on by the time that has passed."""
        now = self._now()
        passed, self._ticked = min(now - self._ticked, LONG_STEP), now
        self.drain()
        if not self.playing or self.index is None:
            return
        self.position = min(self.position + passed * self.speed, self.index.end)
        if self._playback is not None:
            self._playback.ask(self.position)
        if self.position >= self.index.end:
            self.playing = False

    def play(self) -> None:
        """Go on; from the beginning where it stands at the end."""
        if self.index is None:
            return
        if self.position >= self.index.end:
            self.seek(self.index.start)
        self._ticked, self.playing = self._now(), True

    def pause(self) -> None:
        """Stand still."""
        self.playing = False

    def seek(self, at: float) -> None:
        """Go to a moment [s since 1970], within the recording."""
        if self.index is None or self._playback is None or not math.isfinite(at):
            return
        at = min(max(at, self.index.start), self.index.end)
        back = not at >= self.position
        self.position = at
        if back:  # what was told later is not true yet
            self.feeds.forget()
            self.feeds.link(True)
        self._playback.ask(at, anew=back)

    def tell_again(self) -> None:
        """Have all of this moment told, to who listens since now."""
        if self._playback is not None:
            self._playback.ask(self.position, anew=True)

    def step_event(self, way: int) -> None:
        """Go to the event after (1) or before (-1) this moment; nothing where there is none."""
        if self.index is None:
            return
        times = [time for time, _ in self.index.events]
        later = [time for time in times if time > self.position + 1e-3]
        before = [time for time in times if time < self.position - 1e-3]
        if way > 0 and later:
            self.seek(min(later))
        elif way < 0 and before:
            self.seek(max(before))

    def series(self, topic: str, path: str, take: Callable[[Any], object]) -> None:
        """Read a field over the whole recording; `take` gets its times [s since 1970] and values when they are there."""
        if self.index is not None:
            self._series[topic, path] = take
            self._jobs.submit(self._gather, self.index, (topic, path))
