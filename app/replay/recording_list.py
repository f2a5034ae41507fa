"""The recordings that there are: of which robot, when, how long, how large; looked at in a thread, each once."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from app.core.waking import wake_trigger
from app.link.feeds import Mailbox
from app.replay.recording_file import ASK_EVERY, RecordingError, RecordingFile
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets.core.language import mark, tr

__all__ = ["CANNOT", "Glimpse", "RecordingList", "glimpse"]

log = logging.getLogger(__name__)

CANNOT = mark("{name} cannot be read ({fault}).")

MAX_LISTED = 200
"""More of them nobody looks through; the newest are shown."""
MAX_STEPS = 200_000
"""Records and chunks that are passed over to find the end of one: a second or two of a slow device."""
MAX_NAME = 80
"""Letters of a robot's name that are shown."""


@dataclass(frozen=True, slots=True)
class Glimpse:
    """What is known of a recording from its two ends."""

    path: Path
    size: int = 0
    """[byte]"""
    robot: str = ""
    """Empty where it did not say."""
    start: float = math.nan
    """[s since 1970]; NaN while that is not known."""
    end: float = math.nan
    problem: str = ""
    """What is wrong with it, as a sentence."""

    @property
    def duration(self) -> float:
        """[s]; NaN while that is not known."""
        return self.end - self.start


def glimpse(path: Path, ended: Callable[[], bool] = lambda: False) -> Glimpse:
    """Look at both ends of a recording; what goes wrong is its `problem`.

    Where it takes long to find the end, because the file has no chunks, or `ended` says so, that end is not known.
    """
    try:
        file = RecordingFile(path)
    except RecordingError as error:
        return Glimpse(path, _size(path), problem=str(error))
    except OSError as error:
        return Glimpse(path, problem=f"{path.name}: {error.strerror or error}")
    try:
        return _ends(file, ended)
    except OSError as error:
        return Glimpse(path, file.size, problem=f"{path.name}: {error.strerror or error}")
    finally:
        file.close()


def _ends(file: RecordingFile, ended: Callable[[], bool]) -> Glimpse:
    asked = 0

    def enough(_: int) -> bool:
        nonlocal asked
        asked += 1
        return asked * ASK_EVERY > MAX_STEPS or ended()

    pieces = file.pieces(enough)
    first = last = next(pieces, None)
    for last in pieces:  # noqa: B007 - only the last one counts
        pass
    if first is None or last is None:
        return Glimpse(file.path, file.size, problem=" ".join(file.problems))
    records = file.read(first)
    known = not ended() and asked * ASK_EVERY <= MAX_STEPS
    start, end = file.span(first)[0], file.span(last)[1] if known else math.nan
    infos = (record.message() for record in records if record.channel.topic == "/robot/info")
    info = next((one for one in infos if isinstance(one, RobotInfo)), None)
    robot = info.name[:MAX_NAME] if info is not None else ""
    return Glimpse(file.path, file.size, robot, start, end, " ".join(file.problems))


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0


class RecordingList:
    """Lists a folder and looks into what is new there. Everything here happens in the UI thread."""

    def __init__(self, files: Callable[[], list[Path]]) -> None:
        """`files` gives those that there are, the newest first."""
        self._files = files
        self._known: dict[tuple[Path, int], Glimpse] = {}
        self._ended = threading.Event()
        self._mailbox = Mailbox(wake_trigger(self.drain))
        self._jobs: ThreadPoolExecutor | None = None
        self._asked: set[tuple[Path, int]] = set()
        self.on_change: Callable[[], object] = lambda: None
        """Called when more is known."""

    @property
    def glimpses(self) -> list[Glimpse]:
        """The newest first; of those that have not been looked at yet only their size."""
        found = []
        for path in self._files()[:MAX_LISTED]:
            key = path, _size(path)
            found.append(self._known.get(key) or Glimpse(path, key[1]))
        return found

    def refresh(self) -> None:
        """Look into what is new."""
        for path in self._files()[:MAX_LISTED]:
            key = path, _size(path)
            if key not in self._known and key not in self._asked:
                if self._jobs is None:
                    self._ended = threading.Event()  # that of a thread which has not ended yet stays set
                    self._jobs = ThreadPoolExecutor(1, "recordings")
                self._asked.add(key)
                self._jobs.submit(self._look, key, self._ended)

    def _look(self, key: tuple[Path, int], ended: threading.Event) -> None:
        if ended.is_set():
            return
        try:
            seen = glimpse(key[0], ended.is_set)
        except Exception as fault:  # a thread that ends silently would be looking for ever
            log.exception("%s", key[0])
            seen = Glimpse(*key, problem=tr(CANNOT).format(name=key[0].name, fault=type(fault).__name__))
        if not ended.is_set():
            self._mailbox.queue("glimpse", (key, seen), 0.0)

    def drain(self) -> None:
        """Take in what has been seen."""
        for _, post in self._mailbox.drain():
            key, seen = post.value
            self._known[key] = seen
            self._asked.discard(key)
        listed = {(path, _size(path)) for path in self._files()[:MAX_LISTED]}
        self._known = {key: seen for key, seen in self._known.items() if key in listed}
        self.on_change()

    def close(self) -> None:
        """End the thread; what is known is kept."""
        self._ended.set()
        if self._jobs is not None:
            self._jobs.shutdown(wait=False, cancel_futures=True)  # fingers are not held up by a long file
            self._jobs = None
        self._asked.clear()
