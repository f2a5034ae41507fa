"""Status of the robot in the few words of the top bar: mode, position by satellite, control."""

from __future__ import annotations

import math

from app.session.session import Session
from app.session.steering import YOU, Steering, steering
from bridge.msgs.pilothouse_msgs import PlaceCandidates, TaskStatus
from bridge.msgs.sensor_msgs import NavSatFix
from widgets.core.language import mark, tr
from widgets.core.quantities import said

__all__ = ["control", "control_nav", "fix", "mode", "standing"]

MAX_NAME_LENGTH, MAX_BRIEF_LENGTH = 14, 8
"""Letters of a driver's name in the bar, and on a button of a phone's navigation."""

MODES = {
    "READY": ("sports_esports", "muted"),
    "MANUAL": ("sports_esports", "accent"),
    "AUTO": ("autorenew", "plan"),
    "PAUSED": ("pause_fill", "warn"),
    "STOPPED": ("front_hand", "danger"),
}
"""Mode of the robot to icon and role."""
_MODE_WORDS = (mark("READY"), mark("MANUAL"), mark("AUTO"), mark("PAUSED"), mark("STOPPED"))
CONTROLS = {
    "mine": ("person", "accent", mark("you have control"), mark("you")),
    "free": ("lock_open", "text", mark("take control"), mark("free")),
    "unknown": ("help", "muted", mark("control unknown"), mark("unknown")),
    "none": ("lock_open", "muted", mark("anyone may drive"), mark("anyone")),
}
"""Who has control to icon, role, words of the chip, and its words where there is little room."""


def mode(session: Session, form: str = "wide") -> tuple[str, str, str]:
    """Words, icon and role of who steers the robot, and with what task, for a window of this shape."""
    if not session.connected:
        return tr("no link"), "signal_disconnected", "muted"
    if session.robot.foreign and session.robot_stop.local.latched:
        return "STOP", *MODES["STOPPED"]
    if session.link.silent:  # it may do something else by now, and who has control is unknown as well
        return tr("unknown"), "help", "muted"
    how = steering(session)
    if how is None:
        return "—", "signal_disconnected", "muted"
    words = tr(how.mode) if form == "tall" else _long_mode(how, form, _halt(session, how.mode))
    return words, *MODES.get(how.mode, ("help", "muted"))


def _halt(session: Session, mode: str) -> str:
    """Why it does not go though nobody holds it, as in `waiting`; empty where it goes or is held."""
    asked: PlaceCandidates | None = session.feeds.latest("/localisation/candidates")
    if mode in ("AUTO", "READY") and asked is not None and len(asked.candidates) > 1:
        return tr("unsure")
    task: TaskStatus | None = session.feeds.latest("/task/status")
    if mode != "AUTO" or task is None or task.state != "RUNNING":
        return ""
    return {"waiting": tr("waiting"), "unsure": tr("unsure")}.get(task.phase, "")


def _long_mode(how: Steering, form: str, halt: str) -> str:
    if halt:
        return f"{tr(how.mode)} · {halt}"
    if how.mode in ("AUTO", "PAUSED"):
        return f"{tr(how.mode)} · {how.task}" if how.task else tr(how.mode)
    if how.mode != "MANUAL":
        return tr(how.mode)
    if how.waits and form == "wide" and how.task:
        return tr("MANUAL · {task} paused").format(task=how.task)
    if how.waits:
        return tr("MANUAL · paused")
    return f"{tr('MANUAL')} · {tr('you') if how.who == YOU else _short(how.who)}"


def fix(session: Session) -> tuple[str, str]:
    """Words and role of the position by satellite."""
    told: NavSatFix | None = session.feeds.latest("/fix")
    live = session.feeds.state("/fix") == "live"
    good = told is not None and told.status.status >= 0
    text = "—" if told is None else _accuracy(told) if good else tr("no fix")
    return text, "ok" if good and live else "muted"


def control(session: Session, *, brief: bool) -> tuple[str, str, str]:
    """Words, icon and role of who has control, who asks for it and how long still."""
    authority, who = session.authority, session.control
    status, left = authority.status, _countdown(authority.left)
    driver, asker = _short(status.driver), _short(status.requested_by)
    if authority.asked:
        return tr("{name} asks{left}").format(name=asker, left=left), "person", "warn"
    if authority.asking:
        return tr("asked {name}{left}").format(name=driver, left=left), "hourglass_top", "accent"
    if who == "other":
        if session.command_sent("request"):
            return tr("asking {name} …").format(name=driver), "hourglass_top", "accent"
        by = driver if brief else tr("driven by {driver}").format(driver=driver)
        return f"{by} · {tr('{name} asks').format(name=asker)}" if asker else by, "person", "warn"
    icon, role, *words = CONTROLS[who]
    if who == "free" and session.command_sent("acquire"):
        return tr("asking …"), icon, role
    return tr(words[brief]), icon, role


def control_nav(session: Session) -> tuple[str, str, str]:
    """Words, icon and role of what a phone has room for of control; without a role it is as it should be, or free."""
    authority = session.authority
    if authority.status.requested_by and session.control in ("mine", "other"):
        return tr("Ask{left}").format(left=_countdown(authority.left)), "hourglass_top", "warn"
    who = session.control
    if who == "other":
        return _short(authority.status.driver, MAX_BRIEF_LENGTH), "lock", "warn"
    return tr("You") if who == "mine" else tr("Control"), CONTROLS[who][0], ""


def standing(session: Session) -> tuple[object, ...]:
    """Everything that the frame shows at once when it changes: who the robot is, its task, its mode, who has it."""
    status = session.control_status
    task: TaskStatus | None = session.feeds.latest("/task/status")
    return (
        session.robot.name,
        session.link_state.phase,
        session.robot.capabilities,
        task and (task.task_id, task.state),
        session.link.driving,
        status and (status.mode, status.stopped, status.driver_id, status.requested_by_id),
    )


def _countdown(left: float) -> str:
    """As in ` · 8 s`; empty while it is not known."""
    return f" · {math.ceil(left)} s" if math.isfinite(left) else ""


def _short(name: str, longest: int = MAX_NAME_LENGTH) -> str:
    """The beginning of a long name."""
    return name if len(name) <= longest else f"{name[: longest - 1].rstrip()}…"


def _accuracy(fix: NavSatFix) -> str:
    """How far off the position may be, as in `±1.2 m`; the bare fact where the receiver does not say."""
    if not fix.position_covariance_type or not fix.position_covariance:
        return "fix"
    return f"±{said(math.sqrt(max(0.0, fix.position_covariance[0])), 'height', 1).words}"
