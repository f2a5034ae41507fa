"""The recordings that there are: of which robot, when, how long, how large; looked at in a thread, each once."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from app.core.waking import wake_trigger
from app.link.feeds import Mailbox
from app.replay.recording_file import RecordingError, RecordingFile
from bridge.msgs.pilothouse_msgs import RobotInfo

__all__ = ["Glimpse", "RecordingList", "glimpse"]

MAX_LISTED = 200
"""More of them nobody looks through; the newest are shown."""


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


def glimpse(path: Path) -> Glimpse:
    """Look at both ends of a recording; what goes wrong is its `problem`."""
    try:
        file = RecordingFile(path)
    except RecordingError as error:
        return Glimpse(path, _size(path), problem=str(error))
    except OSError as error:
        return Glimpse(path, problem=f"{path.name}: {error.strerror or error}")
    try:
        pieces = list(file.pieces())
        first = file.read(pieces[0]) if pieces else []
        start, end = (file.span(pieces[0])[0], file.span(pieces[-1])[1]) if pieces else (math.nan, math.nan)
    except OSError as error:
        return Glimpse(path, file.size, problem=f"{path.name}: {error.strerror or error}")
    finally:
        file.close()
    infos = (record.message() for record in first if record.channel.topic == "/robot/info")
    info = next((one for one in infos if isinstance(one, RobotInfo)), None)
    problem = " ".join(file.problems)
    return Glimpse(path, file.size, info.name if info is not None else "", start, end, problem)


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
                    self._ended.clear()
                    self._jobs = ThreadPoolExecutor(1, "recordings")
                self._asked.add(key)
                self._jobs.submit(self._look, key)

    def _look(self, key: tuple[Path, int]) -> None:
        if not self._ended.is_set():
            self._mailbox.queue("glimpse", (key, glimpse(key[0])), 0.0)

    def drain(self) -> None:
        """Take in what has been seen."""
        for _, post in self._mailbox.drain():
            key, seen = post.value
            self._known[key] = seen
            self._asked.discard(key)
        self.on_change()

    def close(self) -> None:
        """End the thread; what is known is kept."""
        self._ended.set()
        if self._jobs is not None:
            self._jobs.shutdown(wait=False, cancel_futures=True)  # fingers are not held up by a long file
            self._jobs = None
        self._asked.clear()
