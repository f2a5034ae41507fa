"""Limits on log lines that strangers cause: the first of each kind in a minute, then one line with the number of the rest."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

__all__ = ["STRANGERS", "LogLimit"]

MAX_LINES = 20
"""Lines of one kind in one window."""
WINDOW = 60.0
"""[s]"""
MAX_KINDS = 200
"""Kinds that are told apart; all further ones count as one."""


class _Kind:
    """The lines of one kind in the present window."""

    def __init__(self, began: float) -> None:
        self.began = began
        self.count = 0


class LogLimit(logging.Filter):
    """A filter for loggers; lines are of one kind when they come from one logger and one statement."""

    def __init__(self, clock: Callable[[], float] = time.monotonic, max_lines: int = MAX_LINES) -> None:
        """`clock` only goes forward [s]."""
        super().__init__()
        self._clock, self._max_lines = clock, max_lines
        self._kinds: dict[tuple[str, str], _Kind] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether the line is written; what is no printable character in it is written as its escape: a line is one line."""
        now, key = self._clock(), (record.name, str(record.msg)[:200])
        if key not in self._kinds and len(self._kinds) >= MAX_KINDS:
            key = ("", "")
        kind = self._kinds.get(key)
        if kind is not None and now - kind.began >= WINDOW:
            self._end(key, kind)
            kind = None
        if kind is None:
            kind = self._kinds[key] = _Kind(now)
        kind.count += 1
        if kind.count > self._max_lines:
            return False
        text = record.getMessage()
        if not text.isprintable():
            record.msg, record.args = "%s", (_printable(text),)
        return True

    def flush(self) -> None:
        """Log the number of lines that were left out in windows that are over; to be called every second or so."""
        now = self._clock()
        for key, kind in list(self._kinds.items()):
            if now - kind.began >= WINDOW:
                self._end(key, kind)

    def forget(self) -> None:
        """Count anew."""
        self._kinds.clear()

    def _end(self, key: tuple[str, str], kind: _Kind) -> None:
        del self._kinds[key]
        left_out = kind.count - self._max_lines
        if left_out > 0:
            log = logging.getLogger(__name__)
            log.warning("%d more lines of %s within %g s: %s", left_out, key[0] or "others", WINDOW, key[1])


def _printable(text: str) -> str:
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in text)


STRANGERS = LogLimit()
"""For the loggers of what anybody in the network can cause."""
