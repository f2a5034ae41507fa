"""Banners over every screen of a robot that stay for as long as they are true: its link does not stand, it or drawing is slow."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.screens.shell.notices import Notices
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import ControlStatus, PlaceCandidates
from widgets.core.language import figure, mark, tr
from widgets.core.quantities import quantity_words
from widgets.parts.kit import Banner
from widgets.status.where_card import WhereCard

__all__ = ["StandingBanners"]

SLOW_DRAWING = mark(
    "This device draws slowly: the screen changes at most 15 times a second until it is faster."
)


def loop_words(status: ControlStatus) -> str:
    """That the robot's loop or its simulation lags, as one sentence; empty while it keeps up."""
    if not status.loop_cap < 1.0:
        return ""
    late, rests = quantity_words(status.loop_lag, "duration"), status.loop_cap <= 0.0
    if status.real_time_factor < 1.0:
        words = (
            tr("Simulation at {factor} of real time, {late} behind: the robot rests.")
            if rests
            else tr("Simulation at {factor} of real time, {late} behind: the robot goes slower.")
        )
        return words.format(factor=figure(status.real_time_factor, 1), late=late)
    words = (
        tr("The robot's computer is {late} late: the robot rests.")
        if rests
        else tr("The robot's computer is {late} late: the robot goes slower.")
    )
    return words.format(late=late)


class StandingBanners:
    """Why the robot cannot be reached and when it is tried again; that it lags; and that what is seen changes less often than usual."""

    def __init__(self, session: Session, notices: Notices, by_hand: Callable[[bool], object]) -> None:
        """`by_hand` leads to the map: to point at the robot's place there, or only to look."""
        self._session, self._notices = session, notices
        self.link = Banner(level="danger")
        self.loop = Banner(level="warn")
        self.drawing = Banner(text=tr(SLOW_DRAWING), level="info", closable=True)
        """A tap takes it away until drawing becomes slow anew."""
        self.drawing.bind(on_close=self._read)
        self.where = WhereCard()
        """The robot's question at which of several places it is."""
        self.where.bind(on_choose=lambda _, number: session.command("choose_place", id=number))
        self.where.bind(on_by_hand=lambda _: by_hand(True), on_look=lambda _: by_hand(False))
        self.banners = self.link, self.loop, self.drawing, self.where
        self._was_read = False
        self._asked: PlaceCandidates | None = None

    def tick(self, *, slow: bool, tight: bool, mapped: bool) -> None:
        """Bring them up to date; ten times a second. `slow` drawing is not said where room is `tight` and a card waits for a finger; the screen is a map where it is `mapped`."""
        self.where.mapped = mapped
        self._was_read = self._was_read and slow
        shown = slow and not self._was_read and not (tight and self._notices.asks)
        self._notices.keep(self.drawing, shown=shown, first=True)
        session = self._session
        self._tick_where()
        lags = loop_words(session.authority.status) if session.connected else ""
        self.loop.text = lags or self.loop.text
        self._notices.keep(self.loop, shown=bool(lags), first=True)
        if not session.connected:
            wait = session.retry_in
            again = tr(" Trying again in {wait} s.").format(wait=math.ceil(wait)) if wait > 0 else ""
            self.link.text = session.link_state.sentence + again
        self._notices.keep(self.link, shown=not session.connected, first=True)

    def _tick_where(self) -> None:
        """Have the question on the glass for as long as the robot asks it and can be answered from here or by somebody."""
        session, card = self._session, self.where
        asked: PlaceCandidates | None = session.feeds.latest("/localisation/candidates")
        if asked is not None and asked is not self._asked:
            self._asked = asked
            card.show(asked)
        card.blocked = not session.may_ask or session.command_sent("choose_place")
        driver = session.authority.status.driver if session.control == "other" else ""
        card.why_not = tr("{driver} has control and can answer.").format(driver=driver) if driver else ""
        asks = card.open and session.connected and session.robot.offers("/localisation/choose")
        self._notices.keep(card, shown=asks)

    def _read(self, _: object) -> None:
        self._was_read = True
