"""The response log: one line of JSON for each command somebody gave, kept on the handheld, bounded in size.

log = ResponseLog(folder / "responses")
log.put(Response(id=…, session=…, method="voice", recognised="stop", …))
everything = read(folder / "responses")

All times in the file are seconds since 1970 by the handheld's clock as it was when the app started, plus what a clock that
nobody sets has counted since: differences between them are exact even where somebody sets the time of day.
"""

from __future__ import annotations

import itertools
import logging
import queue
import threading
from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO

import msgspec

__all__ = ["FILE", "KINDS", "Response", "ResponseLog", "files", "lines", "read"]

log = logging.getLogger(__name__)

FILE = "responses.jsonl"
"""The file that is written; `responses-1.jsonl` is the one before it, and so on."""
BYTES, FILES = 1_000_000, 8
"""A file is closed when it has so many bytes; so many files are kept, the oldest is deleted."""
MAX_WAITING = 1000
"""Lines that may wait for the disk; beyond that the newest are dropped and counted."""
MAX_KEPT = 20_000
"""At most so many, the newest, are read into memory."""
MAX_SNIPPET = 20_000
"""A snippet that is longer as JSON is left out [bytes]."""
KINDS = ("command", "drive", "selection", "armed")
"""What a line tells of: a command; driving from its begin to its end; something chosen on a screen by switches; for how
long a method was listening."""


class Response(msgspec.Struct, kw_only=True):
    """One line of the log. None where something is not known or did not happen."""

    kind: str = "command"
    """One of `KINDS`."""
    id: str = ""
    session: str = ""
    """From the app's start to its end."""
    user: str = ""
    """A number or letters chosen in the study; never a name that the app knows."""
    robot: str = ""
    method: str = ""
    """As in `app.intents.intents.METHODS`."""
    posture: str = ""
    """`standing` or `walking`; empty for not known."""
    prompt_id: str = ""
    """Of the prompt it answers, in the study; empty outside of it and where nobody asked."""
    intended: str = ""
    """The intent that was prompted; empty outside of the study and where nobody asked."""
    recognised: str = ""
    """The intent that was understood; empty for none."""
    said: str = ""
    """What was understood, in words."""
    confidence: float | None = None
    """0 to 1."""
    verdict: str = ""
    """What became of it in the app, as of `app.intents.intents.Verdict`."""
    rejected: str = ""
    """Why nothing was done; empty where something was."""
    t_prompt: float | None = None
    """When the prompt was shown [s]."""
    t_input_start: float | None = None
    """When gesture, word or touch began [s]."""
    t_input_end: float | None = None
    t_decided: float | None = None
    """When the app knew what was meant [s]."""
    t_sent: float | None = None
    """When the command left for the robot [s]."""
    t_ack: float | None = None
    """When the robot answered [s]."""
    t_effect: float | None = None
    """When the robot's own state had changed as asked [s]."""
    outcome: str = ""
    """`accepted`, `refused` or `no_reply`; empty where nothing was sent."""
    undo: bool = False
    """Taken back soon after: cancelled at the bar, or by the opposite command."""
    presses: int | None = None
    """Of switches for this selection."""
    seconds: float | None = None
    """How long the method was listening, of `armed` [s]."""
    noise_db: float | None = None
    """Level of noise when it was understood [dB]."""
    snippet: Any = None
    """Acceleration or phone posteriors of it, only where the user has agreed."""


class ResponseLog:
    """Writes in a thread of its own, which starts with the first line; `put` never waits."""

    def __init__(self, folder: Path, *, size: int = BYTES, count: int = FILES) -> None:
        """`size` is of one file [bytes], `count` how many are kept, 1 or more."""
        self.folder, self._size, self._count = folder, size, count
        self.problem = ""
        """One sentence while the disk fails; empty when all is well."""
        self.dropped = 0
        """Lines that did not get into the file."""
        self._counting = threading.Lock()
        self._queue: queue.Queue[bytes | Callable[[], object] | None] = queue.Queue(MAX_WAITING)
        self._thread: threading.Thread | None = None
        self._closed = False

    def put(self, response: Response) -> None:
        """Write a line; what is too long of a snippet is left out."""
        line = msgspec.json.encode(response)
        if response.snippet is not None and len(msgspec.json.encode(response.snippet)) > MAX_SNIPPET:
            line = msgspec.json.encode(msgspec.structs.replace(response, snippet=None))
        self._give(line)

    def erase(self, timeout: float = 5.0) -> None:
        """Delete every line there is, those that wait included; OSError where that fails or takes longer than `timeout` [s]."""
        self._drop_waiting()
        if self._thread is None or self._closed:
            self._erase()
            return
        done, failed = threading.Event(), []

        def job() -> None:
            try:
                self._erase()
            except OSError as error:
                failed.append(error)
            done.set()

        with suppress(queue.Full):
            self._queue.put(job, timeout=timeout)
            done.wait(timeout)
        if failed:
            raise failed[0]
        if not done.is_set():
            raise TimeoutError("the disk does not answer")

    def _drop_waiting(self) -> None:
        kept: list[Callable[[], object] | None] = []
        with suppress(queue.Empty):
            while True:
                item = self._queue.get_nowait()
                kept += [] if isinstance(item, bytes) else [item]
        for one in kept:
            self._queue.put(one)

    def flush(self, timeout: float = 2.0) -> bool:
        """Wait until everything put so far is on the disk; False where that takes longer than `timeout` [s]."""
        if self._thread is None or self._closed:
            return self._thread is None or not self._thread.is_alive()
        done = threading.Event()
        try:
            self._queue.put(done.set, timeout=timeout)
        except queue.Full:
            return False
        return done.wait(timeout)

    def close(self) -> None:
        """Write what waits and end the thread; later lines are ignored."""
        self._closed = True
        if self._thread is not None:
            try:
                self._queue.put(None, timeout=2.0)
            except queue.Full:
                log.warning("the response log was left with lines that the disk did not take")
            self._thread.join(5.0)

    def _lose(self) -> None:
        with self._counting:
            self.dropped += 1

    def _give(self, item: bytes) -> None:
        if self._closed:
            return
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="responses", daemon=True)
            self._thread.start()
        try:
            self._queue.put_nowait(item)
        except queue.Full:
            self._lose()

    def _run(self) -> None:
        while (item := self._queue.get()) is not None:
            try:
                if isinstance(item, bytes):
                    self._write(item)
                    self.problem = ""
                else:
                    item()
            except OSError as error:
                if isinstance(item, bytes):
                    self._lose()
                self.problem = f"The response log could not be written: {error.strerror or error}."
                log.warning("%s", self.problem)

    def _write(self, line: bytes) -> None:
        path = self.folder / FILE
        self.folder.mkdir(parents=True, exist_ok=True)
        if path.exists() and path.stat().st_size + len(line) + 1 > self._size:
            self._rotate(path)
        with path.open("ab+") as file:
            file.write((b"\n" if _is_half(file) else b"") + line + b"\n")

    def _rotate(self, path: Path) -> None:
        """The oldest file goes, each other becomes one older."""
        all_ = [path, *(_numbered(self.folder, number) for number in range(1, self._count))]
        all_[-1].unlink(missing_ok=True)
        for younger, elder in reversed(list(itertools.pairwise(all_))):
            if younger.exists():
                younger.replace(elder)

    def _erase(self) -> None:
        for path in files(self.folder):
            path.unlink(missing_ok=True)


def _is_half(file: BinaryIO) -> bool:
    """Its last line has no end: power or room ran out in it, and what follows is a line of its own."""
    if file.seek(0, 2) == 0:
        return False
    file.seek(-1, 2)
    return file.read(1) != b"\n"


def _numbered(folder: Path, number: int) -> Path:
    return folder / FILE.replace(".", f"-{number}.")


def files(folder: Path) -> list[Path]:
    """Those there are, the oldest first."""
    older = [_numbered(folder, number) for number in range(FILES * 4, 0, -1)]
    return [path for path in [*older, folder / FILE] if path.is_file()]


def lines(folder: Path) -> Iterable[bytes]:
    """Every line of every file, the oldest first; OSError where one cannot be read."""
    for path in files(folder):
        with path.open("rb") as file:
            yield from file


def read(folder: Path, most: int = MAX_KEPT) -> tuple[list[Response], int]:
    """The newest responses, at most `most`, the oldest of them first; and how many lines could not be understood.

    A power cut may leave half a line: that one is left out and counted, all others are read.
    """
    kept: deque[Response] = deque(maxlen=most)
    decode, wrong = msgspec.json.Decoder(Response).decode, 0
    try:
        for line in lines(folder):
            try:
                kept.append(decode(line))
            except (msgspec.DecodeError, UnicodeDecodeError):
                wrong += bool(line.strip())
    except OSError as error:
        log.warning("the response log could not be read: %s", error)
    return list(kept), wrong
