"""Spans of driving for the response log: each has a method, a begin and an end."""

from __future__ import annotations

from typing import Any

from app.study.response_timing import ResponseTracks

__all__ = ["DriveSpans"]

MAX_GAP = 1.0
"""Driving that rests for so long has ended [s]; a stick that goes through its middle ends nothing."""


class DriveSpans:
    """Of one run of the app."""

    def __init__(self, tracks: ResponseTracks) -> None:
        """`tracks` is given each span when it has ended."""
        self._tracks = tracks
        self._span: tuple[str, float, float] | None = None
        """Method, begin and last instant of the driving that goes on [s]; None for none."""

    def update(self, link: Any, now: float) -> None:
        """Each tick [s]; `link` is that to the robot, None without one."""
        if link is not None and link.driving and link.driven_by.method:
            method = link.driven_by.method
            if self._span is None or self._span[0] != method:
                self.end()
                self._span = (method, now, now)
            self._span = (method, self._span[1], now)
        elif self._span is not None and now - self._span[2] > MAX_GAP:
            self.end()

    def end(self) -> None:
        """Driving has ended."""
        span, self._span = self._span, None
        if span is not None:
            self._tracks.drove(*span)
