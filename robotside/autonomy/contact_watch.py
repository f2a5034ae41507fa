"""Contacts of the bumper: they pause the task and are reported once."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Bumper
from robotside.core.notice import Notice
from robotside.kinds.registry import kind_of
from robotside.limits.bumper_guard import CONTACT_TIME
from robotside.localisation.pose_estimator import PoseEstimator
from robotside.records.events import Say
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.engine import Engine

__all__ = ["ContactWatch"]


class ContactWatch:
    """Watches the bumper."""

    def __init__(
        self,
        engine: Engine,
        pose_estimator: PoseEstimator,
        situation: Situation,
        say: Say,
        *,
        kind: str = "",
    ) -> None:
        """Of a robot of a `kind`: water moves some where they lie."""
        self._engine, self._pose_estimator, self._situation, self._say = (
            engine,
            pose_estimator,
            situation,
            say,
        )
        self._drifts = kind_of(kind).handling.drifts
        self._pressed, self._released_at = False, -math.inf

    def on_bumper(self, msg: Bumper, now: float) -> None:
        """The bumper was measured, at `now` [s, robot clock]; docking touches on purpose."""
        was, self._pressed = self._pressed, msg.pressed
        self._situation.touched = msg.pressed
        self._pose_estimator.on_bumper(msg)
        if was and not msg.pressed:
            self._released_at = now
        if not msg.pressed or was or self._meant:
            return
        self._engine.pause(Notice(Code.TASK_BUMPED, "Paused: the bumper touched something."), "alarm")
        if now - self._released_at < CONTACT_TIME:
            return
        pose = self._pose_estimator.pose
        at = (pose.x, pose.y) if pose else None
        side = _side(msg.bearing)
        touched = Notice(Code.BUMPER_TOUCHED, f"The bumper touched something {side}.", side=side)
        self._say("contact", touched, "alarm", at=at)

    @property
    def _meant(self) -> bool:
        """It docks, or it lies at the dock that charges it and waves move it there."""
        if self._engine.running:
            return self._situation.touches
        return self._drifts and self._situation.charging


def _side(bearing: float) -> str:
    """Where on the robot that is, in words, of a bearing [rad]."""
    if math.isnan(bearing):
        return "somewhere"
    if abs(bearing) < 0.5:
        return "ahead"
    if abs(bearing) > 2.6:
        return "behind"
    return "on the left" if bearing > 0 else "on the right"
