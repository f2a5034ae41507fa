"""The robot's events on their way into the logbook, in the words of the handheld that they concern."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from app.core.command_origin import gave_stop
from app.link.commands import Outcome
from app.link.feeds import Post
from app.session.control import Authority, Line
from app.session.logbook import Logbook
from app.session.own_events import OwnName
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus

__all__ = ["EventIntake"]

MAX_UNDECIDED = 20
"""Events that may wait for the robot's word of control."""


class Robot(Protocol):
    """The session with one robot, as far as its events need it."""

    authority: Authority
    outcomes: dict[str, Outcome]

    @property
    def link(self) -> Line:
        """The link over which the robot is reached just now."""


class EventIntake:
    """Events of one robot. Everything here happens in the UI thread."""

    def __init__(
        self, robot: Robot, own_name: OwnName, logbook: Logbook, publish: Callable[[Post], object]
    ) -> None:
        """`publish` is called with each event that is new."""
        self._robot, self._logbook, self._publish = robot, logbook, publish
        self.own_name = own_name
        self.shown = False
        """Screens show events as they come."""
        self.early: list[Post] = []
        """Events that came before there was a screen to show them."""
        self._undecided: list[Post] = []
        """Events that may be about us, until the robot's word of control comes."""
        self._task: Post | None = None
        """The newest `/task/status` in the robot's own words."""

    def on_event(self, post: Post) -> None:
        """An event came."""
        robot = self._robot
        if (
            robot.authority.wanted
            and len(self._undecided) < MAX_UNDECIDED
            and self.own_name.undecided(post.value, robot.link.robot_time())
        ):
            self._undecided.append(post)
        else:
            self._take(post)

    def word_task(self, post: Post) -> Post:
        """A post of `/task/status` with its reason in our words."""
        self._task = post
        status: TaskStatus = post.value
        return replace(post, value=self.own_name.task(status, self._robot.link.robot_time()))

    def on_control(self, status: ControlStatus) -> Post | None:
        """The robot names who has control; returns the task's status where that may have been about us."""
        before = self.own_name.known
        self.own_name.hear(status)
        return self._task if self.own_name.known != before else None

    def decide(self) -> None:
        """Take in what waited: whether somebody of our name was us is known now, or never will be."""
        undecided, self._undecided = self._undecided, []
        for post in undecided:
            self._take(post)

    def _take(self, post: Post) -> None:
        outcomes = self._robot.outcomes
        stop = outcomes.get("stop" if "pressed" in post.value.text else "stop_release")
        asked = post.value.kind == "stop" and stop is not None and stop.phase in ("sent", "accepted")
        how = gave_stop(stop.origin) if asked and stop is not None else ""
        event = self.own_name.said(post.value, self._robot.link.robot_time(), asked=asked, how=how)
        if self._logbook.take(event):
            post = replace(post, value=event)
            if not self.shown:
                self.early.append(post)
            self._publish(post)
