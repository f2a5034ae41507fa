"""STOP to all robots while none is connected: no link tells of it, so the response log follows the fleet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from app.core.command_origin import origins
from app.link.commands import Outcome
from app.study.response_timing import ResponseTracks
from app.study.study_app import StudyApp

__all__ = ["StopAllTrack"]


class StopAllTrack:
    """Put down with the tick after it was pressed; done when every robot says that it rests."""

    def __init__(self, tracks: ResponseTracks, on_sent: Callable[[Outcome], object]) -> None:
        """`on_sent` is called when it was put down."""
        self._tracks, self._on_sent = tracks, on_sent
        self._outcome: Outcome | None = None
        """What is under way; None for none."""

    def press(self, now: float) -> None:
        """STOP ALL was pressed [s]."""
        origin = origins.current()
        self._outcome = Outcome(
            "stop",
            self._tracks.new_id(),
            "",
            sent=now,
            origin=replace(origin, said=origin.said or "STOP ALL"),
        )

    def update(self, app: StudyApp, now: float) -> None:
        """Each tick [s]; `app` is asked for its `fleet` while something is under way."""
        outcome = self._outcome
        if outcome is None:
            return
        fleet = app.fleet
        if not outcome.phase:
            self._outcome = outcome = replace(outcome, phase="sent")
            self._tracks.outcome(outcome, outcome.sent)
            self._on_sent(outcome)
        if fleet.active and fleet.total and fleet.stopped == fleet.total:
            self._tracks.outcome(replace(outcome, phase="accepted"), now)
            self._tracks.done(outcome.command_id, now)
            self._outcome = None
        elif not fleet.active:
            self._outcome = None

    def clear(self) -> None:
        """Follow nothing any more."""
        self._outcome = None
