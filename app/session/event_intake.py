"""The robot's events on their way into the logbook, in the words of the handheld that they concern."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Protocol

from app.core.command_origin import gave_stop
from app.link.commands import Outcome
from app.link.feeds import Post
from app.session.authority import Line
from app.session.event_words import own_event, own_reason
from app.session.logbook import Logbook
from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Event

__all__ = ["EventIntake"]

_COMMANDS: Mapping[str, str] = {Code.STOP_PRESSED: "stop", Code.STOP_RELEASED: "stop_release"}
"""Codes of what STOP's commands do, to the name of each."""


class Robot(Protocol):
    """The session with one robot, as far as its events need it."""

    outcomes: dict[str, Outcome]

    @property
    def link(self) -> Line:
        """The link over which the robot is reached just now."""


class EventIntake:
    """Events of one robot. Everything here happens in the UI thread."""

    def __init__(
        self, robot: Robot, own_id: str, logbook: Logbook, publish: Callable[[Post], object]
    ) -> None:
        """By `own_id` the robot publishes this handheld; `publish` is called with each event that is new."""
        self._robot, self._own_id = robot, own_id
        self._logbook, self._publish = logbook, publish
        self.shown = False
        """Screens show events as they come."""
        self.early: list[Post] = []
        """Events that came before there was a screen to show them."""

    def on_event(self, post: Post) -> None:
        """An event came."""
        event = own_event(post.value, self._own_id, self._gave_stop(post.value))
        if self._logbook.add(event):
            post = replace(post, value=event)
            if not self.shown:
                self.early.append(post)
            self._publish(post)

    def word_task(self, post: Post) -> Post:
        """A post of `/task/status` with its reason in our words."""
        return replace(post, value=own_reason(post.value, self._own_id))

    def _gave_stop(self, event: Event) -> str:
        """What gave the STOP of which a fresh `event` tells, where it is the one that was asked for here; else empty."""
        asked = self._robot.outcomes.get(_COMMANDS.get(event.code, ""))
        if asked is None or asked.phase not in ("sent", "accepted"):
            return ""
        return gave_stop(asked.origin) if Logbook.is_news(event, self._robot.link.robot_time()) else ""
