"""Who steers the robot and in which mode, judged once for every place that says it."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from app.core.command_origin import NOBODY, Origin
from app.link.feeds import Feeds
from app.session.robot_profile import RobotProfile
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from widgets.core.task_words import TASKS

__all__ = ["AUTO", "MANUAL", "PAUSED", "READY", "STOPPED", "YOU", "Steering", "steering"]

READY, MANUAL, AUTO, PAUSED, STOPPED = "READY", "MANUAL", "AUTO", "PAUSED", "STOPPED"
YOU = "you"
WAITING = ("PAUSED", "INTERRUPTED")
"""States of a task that goes on later."""


class Steering(NamedTuple):
    """How a robot is steered."""

    mode: str
    """`READY` (nobody steers and no task waits; nor has this handheld, which has control, driven yet), `MANUAL`, `AUTO`, `PAUSED` (a task waits and nobody drives) or `STOPPED`."""
    who: str
    """Who has control: `you`, a name, or empty for nobody."""
    task: str
    """The task that runs or waits, as in `patrol`; empty for none."""
    waits: bool
    """The task waits."""


class _Link(Protocol):
    @property
    def driving(self) -> bool:
        """A stick is pushed."""

    @property
    def driven_by(self) -> Origin:
        """Origin of the last command that moves the robot; `NOBODY` before the first."""


class SteeredRobot(Protocol):
    """The session with a robot, as far as this needs it."""

    feeds: Feeds
    robot: RobotProfile

    @property
    def link(self) -> _Link:
        """The link over which it is reached."""

    @property
    def own_id(self) -> str:
        """The id by which the robot publishes this handheld."""


def steering(session: SteeredRobot) -> Steering | None:
    """By the newest that the robot has told and by the own stick; None while it has told nothing."""
    if session.robot.foreign:  # it tells nobody who drives
        return Steering(MANUAL, YOU, "", False) if session.link.driving else Steering(READY, "", "", False)
    status: ControlStatus | None = session.feeds.latest("/control/status")
    if status is None:
        return None
    told: TaskStatus | None = session.feeds.latest("/task/status")
    who = YOU if status.driver_id and status.driver_id == session.own_id else status.driver
    waits = told is not None and told.state in WAITING
    task = TASKS[told.task].doing if told is not None and told.task in TASKS else ""
    mode = status.mode
    if mode == PAUSED and who == YOU and session.link.driving:
        mode = MANUAL
    elif mode == MANUAL and (not who or (who == YOU and not waits and not _has_driven(session.link))):
        mode = READY
    return Steering(mode, who, task if waits or mode in (AUTO, PAUSED) else "", waits)


def _has_driven(link: _Link) -> bool:
    """Something here has driven the robot, by stick or otherwise, since the link was made."""
    return link.driving or link.driven_by is not NOBODY
