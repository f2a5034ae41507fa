"""The banner over every screen of a robot while its link does not stand."""

from __future__ import annotations

import math

from app.screens.shell.notices import Notices
from app.session.session import Session
from widgets.parts.kit import Banner

__all__ = ["LinkBanner"]


class LinkBanner:
    """Why the robot cannot be reached, and when it is tried again."""

    def __init__(self, session: Session, notices: Notices) -> None:
        self._session, self._notices = session, notices
        self.banner = Banner(level="danger")

    def tick(self) -> None:
        """Bring it up to date; ten times a second."""
        session = self._session
        if not session.connected:
            wait = session.retry_in
            again = f" Trying again in {math.ceil(wait)} s." if wait > 0 else ""
            self.banner.text = session.link_state.sentence + again
        self._notices.keep(self.banner, shown=not session.connected, first=True)
