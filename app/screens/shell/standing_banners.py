"""Banners over every screen of a robot that stay for as long as they are true: its link does not stand, drawing is slow."""

from __future__ import annotations

import math

from app.screens.shell.notices import Notices
from app.session.session import Session
from widgets.core.language import mark, tr
from widgets.parts.kit import Banner

__all__ = ["StandingBanners"]

SLOW_DRAWING = mark(
    "This device draws slowly: the screen changes at most 15 times a second until it is faster."
)


class StandingBanners:
    """Why the robot cannot be reached and when it is tried again; and that what is seen changes less often than usual."""

    def __init__(self, session: Session, notices: Notices) -> None:
        self._session, self._notices = session, notices
        self.link = Banner(level="danger")
        self.drawing = Banner(text=tr(SLOW_DRAWING), level="info", closable=True)
        """A tap takes it away until drawing becomes slow anew."""
        self.drawing.bind(on_close=self._read)
        self.banners = self.link, self.drawing
        self._was_read = False

    def tick(self, *, slow: bool, tight: bool) -> None:
        """Bring them up to date; ten times a second. `slow` drawing is not said where room is `tight` and a card waits for a finger."""
        self._was_read = self._was_read and slow
        shown = slow and not self._was_read and not (tight and self._notices.asks)
        self._notices.keep(self.drawing, shown=shown, first=True)
        session = self._session
        if not session.connected:
            wait = session.retry_in
            again = tr(" Trying again in {wait} s.").format(wait=math.ceil(wait)) if wait > 0 else ""
            self.link.text = session.link_state.sentence + again
        self._notices.keep(self.link, shown=not session.connected, first=True)

    def _read(self, _: object) -> None:
        self._was_read = True
