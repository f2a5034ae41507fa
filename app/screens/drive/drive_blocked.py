"""Reasons why a stick that is pushed does not drive, said where it is pushed."""

from __future__ import annotations

import math
from typing import Any

from app.screens.shell.control_cards import ABOUT as AUTHORITY
from app.screens.shell.screen_host import ScreenHost
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import FlightState
from widgets.core.language import mark, tr

__all__ = ["DriveBlocked", "grounded", "why_not"]

ABOUT = "stick"
"""What the sentences tell of."""


GROUNDED = {
    "landed": mark("It stands on the ground: take off first."),
    "turned_over": mark("It lies on its back, its rotors off."),
}
"""In which phase of a flight no stick moves it, and why."""


def grounded(session: Session) -> str:
    """Which phase of `GROUNDED` a robot that flies says now that it is in; empty for none."""
    told: FlightState | None = session.feeds.latest("/flight")
    known = told is not None and told.phase in GROUNDED and session.feeds.state("/flight") == "live"
    return told.phase if told is not None and known else ""


def why_not(session: Session) -> str:
    """Why the robot cannot be driven from here, as a sentence; empty where it can, or where that is said already."""
    if not session.connected:
        return ""
    if session.may_drive:
        return tr(GROUNDED.get(grounded(session), ""))
    if session.robot.foreign:
        return "" if session.robot_stop.local.latched else tr("This robot has no topic to drive it by.")
    if session.robot_stop.latched:
        return tr("STOP is pressed; hold it to release.")
    if session.control == "other":
        return tr("{name} has control; ask for it.").format(name=session.authority.status.driver)
    if session.link.silent:
        return tr("The link is silent; the stick counts again when the robot is heard.")
    if not math.isfinite(session.link.robot_time()):
        return tr("The robot's clock is not known yet; try again in a moment.")
    return ""


class DriveBlocked:
    """Tells of one push once, and offers what helps."""

    def __init__(self, session: Session, app: ScreenHost) -> None:
        """`app` has the shell that says it."""
        self._session, self._app = session, app
        self._said = ""
        """What lies over the screen, as far as is known here."""

    def notify(self) -> None:
        """The stick was pushed in vain."""
        session, shell, text = self._session, self._app.shell, why_not(self._session)
        if not text or shell is None or any(one.text == text for one in self._toasts()):
            return
        self._said = text
        shell.unsay(AUTHORITY)
        if (
            session.control == "other"
            and not session.authority.asking
            and session.robot.offers("/control/request")
        ):
            shell.notices.offer(text, tr("Ask"), session.take_control, icon="person")
        else:
            shell.say(text, "warn", about=ABOUT)

    def tick(self) -> None:
        """Take it away when it is true no longer."""
        now = why_not(self._session)
        drives = self._session.may_drive and not now
        if self._said and (drives or (now and now != self._said)):
            for toast in self._toasts():
                if toast.text == self._said:
                    toast.parent.remove_widget(toast)
            self._said = ""

    def _toasts(self) -> list[Any]:
        shell = self._app.shell
        return [] if shell is None else [one for one in shell.notices.children if hasattr(one, "text")]
