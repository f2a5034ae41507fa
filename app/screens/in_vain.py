"""Why a stick that is pushed does not drive, said where it is pushed."""

from __future__ import annotations

import math
from typing import Any

from app.session import Session

__all__ = ["InVain", "why_not"]

ABOUT = "stick"
"""What the sentences tell of."""


def why_not(session: Session) -> str:
    """Why the robot cannot be driven from here, as a sentence; empty where it can, or where that is said already."""
    if session.may_drive or not session.connected or session.link.silent:
        return ""
    if session.foreign:
        return "" if session.local_stop.latched else "This robot has no topic to drive it by."
    if session.stop_latched:
        return "STOP is pressed; hold it to release."
    if session.control == "other":
        return f"{session.authority.status.driver} has control, so the stick does nothing."
    if not math.isfinite(session.link.robot_time()):
        return "The robot's clock is not known yet; try again in a moment."
    return ""


class InVain:
    """Tells of one push once, and offers what helps."""

    def __init__(self, session: Session, app: Any) -> None:
        """`app` has the shell that says it."""
        self._session, self._app = session, app

    def tell(self) -> None:
        """The stick was pushed in vain."""
        session, shell = self._session, self._app.shell
        text = why_not(session)
        if not text or shell is None or text in [getattr(one, "text", "") for one in shell.notices.children]:
            return
        if session.control == "other" and not session.authority.asking and session.offers("/control/request"):
            shell.notices.offer(text, "Ask for control", session.take_control, icon="person")
        else:
            shell.say(text, "warn", about=ABOUT)
