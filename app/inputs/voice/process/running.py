"""One process of voice. Nothing here waits for it but the threads that are its own: a process that hangs holds nobody up.

process = Running(command, environment); process.order("{…}")
process.line(1.0)                     # the next line, "" when none came in time, None when it has ended
process.end(); process.last_words     # beside the glass: takes a while
"""

from __future__ import annotations

import contextlib
import logging
import queue
import signal
import subprocess
import threading
from collections.abc import Mapping, Sequence

from app.inputs.voice.process import ending
from app.inputs.voice.process.breakdown import reason

__all__ = ["NOTE_PREFIX", "Running"]

log = logging.getLogger(__name__)

NOTE_PREFIX = "voice: "
"""Lines of its standard error that begin so are of our own and go to the log."""
MAX_NOTES = 20
"""So many of them at most."""
MAX_QUEUE = 256
"""Lines that wait to be taken; it has to wait with more."""
MAX_LINE = 1 << 16
"""A line is cut here [characters]."""


class Running:
    """`order` and `wake` in any thread, at once; `line` and `end` in the one that cares for it."""

    def __init__(self, command: Sequence[str], environment: Mapping[str, str]) -> None:
        """Start it; OSError when that cannot be."""
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            errors="replace",
            env=environment,
        )
        self._orders: queue.SimpleQueue[str | None] = queue.SimpleQueue()
        self._lines: queue.Queue[str | None] = queue.Queue(MAX_QUEUE)
        self._over = threading.Event()
        self._last = ""
        self._threads = [
            threading.Thread(target=job, name=f"voice {name}", daemon=True)
            for name, job in (("orders", self._write), ("events", self._read), ("errors", self._note))
        ]
        for thread in self._threads:
            thread.start()

    @property
    def pid(self) -> int:
        """Its number in the system."""
        return self._process.pid

    @property
    def returncode(self) -> int | None:
        """What it ended with; None while it has not ended, or was not yet seen to."""
        return self._process.returncode

    def order(self, line: str) -> None:
        """Write a line to it, after those before."""
        self._orders.put(line)

    def line(self, timeout: float) -> str | None:
        """Its next line; empty when none came in `timeout` s, None when none will come."""
        try:
            return self._lines.get(timeout=timeout)
        except queue.Empty:
            return ""

    def wake(self) -> None:
        """Have `line` return."""
        with contextlib.suppress(queue.Full):
            self._lines.put_nowait("")

    def end(self, *, hangs: bool = False) -> None:
        """End it with its standard input, and by force after `ENDS`, or at once where it `hangs`; what cannot be ended is left."""
        self._over.set()
        self._orders.put(None)
        if hangs:
            self._process.kill()
        try:
            self._process.wait(ending.END_TIMEOUT)
        except subprocess.TimeoutExpired:
            self._process.kill()
            try:
                self._process.wait(ending.END_TIMEOUT)
            except subprocess.TimeoutExpired:
                log.warning("the voice process %d cannot be ended and is left", self.pid)
                return
        for thread in self._threads:
            thread.join(ending.END_TIMEOUT)

    @property
    def last_words(self) -> str:
        """Why it ended, as far as it told: what killed it, and the last line of its standard error; empty where it ended well."""
        code = self.returncode or 0
        killed = ""
        if code < 0:
            with contextlib.suppress(ValueError):
                killed = signal.Signals(-code).name
        told = ", ".join(filter(None, (killed, self._last)))
        return told or (f"it ended with {code}" if code else "")

    def _write(self) -> None:
        pipe = self._process.stdin
        if pipe is None:
            return
        with contextlib.suppress(OSError, ValueError):  # it has just ended, which `_read` tells
            while (line := self._orders.get()) is not None:
                pipe.write(line + "\n")
                pipe.flush()
        with contextlib.suppress(OSError, ValueError):
            pipe.close()

    def _read(self) -> None:
        pipe = self._process.stdout
        if pipe is None:
            return
        while line := pipe.readline(MAX_LINE):
            self._put(line)
        self._put(None)
        pipe.close()

    def _put(self, line: str | None) -> None:
        while not self._over.is_set():
            try:
                self._lines.put(line, timeout=0.5)
            except queue.Full:
                continue
            return

    def _note(self) -> None:
        pipe, notes = self._process.stderr, 0
        if pipe is None:
            return
        while line := pipe.readline(MAX_LINE):
            if not line.startswith(NOTE_PREFIX):
                self._last = reason(line) or self._last
            elif notes < MAX_NOTES:
                notes += 1
                log.warning("%s", reason(line))
        pipe.close()
