"""How a robot stands, in the few words of the top bar: mode, position by satellite, who has control."""

from __future__ import annotations

import math

from app.session import Session
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from bridge.msgs.sensor_msgs import NavSatFix
from widgets.task_words import TASKS

__all__ = ["control", "fix", "mode"]

MODES = {
    "MANUAL": ("sports_esports", "accent"),
    "AUTO": ("autorenew", "plan"),
    "PAUSED": ("pause_fill", "warn"),
    "STOPPED": ("front_hand", "danger"),
}
"""Mode of the robot to icon and role."""
CONTROLS = {
    "mine": ("person", "accent", "you have control", "you"),
    "free": ("lock_open", "text", "take control", "free"),
    "unknown": ("help", "muted", "control unknown", "unknown"),
    "none": ("lock_open", "muted", "anyone may drive", "anyone"),
}
"""Who has control to icon, role, words of the chip, and its words where there is little room."""


def mode(session: Session, *, brief: bool) -> tuple[str, str, str]:
    """Words, icon and role of who steers the robot, and with what task unless `brief`."""
    status: ControlStatus | None = session.feeds.latest("/control/status")
    if session.foreign and session.connected:
        held = session.local_stop.latched
        return "STOP" if held else "MANUAL", *MODES["STOPPED" if held else "MANUAL"]
    if status is None or not session.connected:
        return "no link" if not session.connected else "—", "signal_disconnected", "muted"
    task: TaskStatus | None = session.feeds.latest("/task/status")
    words = TASKS[task.task].doing if task is not None and task.task in TASKS else ""
    busy = status.mode in ("AUTO", "PAUSED") and words and not brief
    return f"{status.mode} · {words}" if busy else status.mode, *MODES.get(status.mode, ("help", "muted"))


def fix(session: Session) -> tuple[str, str]:
    """Words and role of the position by satellite."""
    told: NavSatFix | None = session.feeds.latest("/fix")
    live = session.feeds.state("/fix") == "live"
    good = told is not None and told.status.status >= 0
    text = "—" if told is None else _accuracy(told) if good else "no fix"
    return text, "ok" if good and live else "muted"


def control(session: Session, *, brief: bool) -> tuple[str, str, str]:
    """Words, icon and role of who has control."""
    who = session.control
    if who == "other":
        driver = session.feeds.latest("/control/status").driver
        return driver if brief else f"driven by {driver}", "person", "warn"
    icon, role, *words = CONTROLS[who]
    asked = session.outcomes.get("acquire")
    if who == "free" and asked is not None and asked.phase == "sent":
        return "asking …", icon, role
    return words[brief], icon, role


def _accuracy(fix: NavSatFix) -> str:
    """How far off the position may be, as in `±1.2 m`; the bare fact where the receiver does not say."""
    if not fix.position_covariance_type or not fix.position_covariance:
        return "fix"
    return f"±{math.sqrt(max(0.0, fix.position_covariance[0])):.1f} m"
