"""STOP in its corner, and the banner of a STOP that this handheld alone holds."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.screens.shell.notices import Notices
from app.session.session import Session
from app.stop.stop_state import silence
from widgets import StopButton
from widgets.parts.kit import Banner

__all__ = ["StopDisplay"]


class StopDisplay:
    """The button sends STOP and its release; what became of it is shown on the button and, where needed, in words."""

    def __init__(self, session: Session, notices: Notices, rest: Callable[[], object]) -> None:
        """`rest` lets every finger go before STOP is sent."""
        self._session, self._notices, self._rest = session, notices, rest
        self.button = StopButton(size_hint=(None, None))
        self.button.bind(on_command=self._stop, on_hold_stop=self._hold, on_release_stop=self._release)
        self.banner = Banner(level="warn")

    def _stop(self, *_: object) -> None:
        self._rest()
        self._session.stop()

    def _hold(self, *_: object) -> None:
        self._session.hold_stop()

    def _release(self, *_: object) -> None:
        self._session.release_stop()

    def show(self) -> None:
        """Bring the button up to date; as soon as something is known, not when the next tick comes."""
        session, button, stop = self._session, self.button, self._session.robot_stop
        if button.phase == "stopped" != stop.phase:
            for kind in ("stop", "task"):
                self._notices.unsay(kind)
        button.ago = "" if math.isnan(stop.lost_for) else silence(stop.lost_for)
        # without a link nothing can be let go, and nothing is offered to be held
        button.local = session.connected and (session.robot.foreign or stop.latched)
        button.phase = stop.phase

    def tick(self) -> None:
        """Say what is known of a STOP that this handheld alone holds, for as long as it holds it."""
        session, banner = self._session, self.banner
        drives = session.link.drive_topic is not None
        text = session.robot_stop.local.sentence(drives, session.connected) if session.robot.foreign else ""
        banner.text = text or banner.text
        banner.level = "ok" if session.robot_stop.phase == "stopped" else "warn"
        if text and banner.parent is None:
            self._notices.unsay("offer")
        self._notices.keep(banner, shown=bool(text))
