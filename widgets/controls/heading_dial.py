"""Dial for a direction: a finger turns the needle, the robot's own heading is drawn beside it.

dial = HeadingDial()
robot.on("/pose", dial.show)
dial.bind(on_command=lambda _, yaw: print(yaw))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, NumericProperty, StringProperty
from kivy.uix.label import Label
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from widgets.core.base import Control
from widgets.core.language import tr
from widgets.core.task_words import heading_of

__all__ = ["HeadingDial"]

STEP = math.radians(5)
"""The needle goes in steps of this [rad]."""

Builder.load_string("""
<HeadingDial>:
    size_hint: None, None
    size: dp(190), dp(190)
    veil_radius: self.width / 2
    canvas:
        Color:
            rgba: theme.line
        SmoothEllipse:
            pos: root.disc[0], root.disc[1]
            size: root.disc[2], root.disc[2]
        Color:
            rgba: theme.raised
        SmoothEllipse:
            pos: root.disc[0] + dp(1.5), root.disc[1] + dp(1.5)
            size: root.disc[2] - dp(3), root.disc[2] - dp(3)
        Color:
            rgba: theme.accent if root.located else (0, 0, 0, 0)
        SmoothTriangle:
            points: root.own
        Color:
            rgba: theme.plan if root.pointed else (0, 0, 0, 0)
        SmoothLine:
            points: root.needle
            width: dp(2.4)
        SmoothEllipse:
            pos: root.knob[0] - dp(15), root.knob[1] - dp(15)
            size: dp(30), dp(30)
    DialWord:
        text: tr('N', 'compass')
        bold: True
        pos: root.center_x - self.width / 2, root.center_y + root.reach * .86 - self.height / 2
    DialWord:
        text: 'E'
        pos: root.center_x + root.reach * .86 - self.width / 2, root.center_y - self.height / 2
    DialWord:
        text: 'S'
        pos: root.center_x - self.width / 2, root.center_y - root.reach * .86 - self.height / 2
    DialWord:
        text: 'W'
        pos: root.center_x - root.reach * .86 - self.width / 2, root.center_y - self.height / 2
    DialWord:
        text: root.words
        role: 'text'
        bold: True
        font_size: theme.size_title
        pos: root.center_x - self.width / 2, root.center_y - self.height / 2
    DialWord:
        text: root.robot_words
        role: 'accent'
        font_size: sp(13)
        pos: root.center_x - self.width / 2, root.center_y - dp(14) - self.height

<DialWord>:
    size_hint: None, None
    size: self.texture_size
    font_name: theme.font
    font_size: sp(14)
    color: theme.roles[root.role]
    disabled_color: self.color
""")


class DialWord(Label):
    """A word on the dial."""

    role = StringProperty("muted")
    """Role of its colour."""


class HeadingDial(Control, Widget):
    """Dispatches `on_command(yaw)` [rad] while a finger turns it."""

    accepts = (PoseWithCovarianceStamped,)

    drags = True
    """A finger that comes down here does not scroll."""

    value = NumericProperty(math.nan)
    """Yaw that is wanted [rad], 0 east, anticlockwise; NaN for where the robot points."""
    robot = NumericProperty(math.nan)
    """Yaw of the robot [rad]; NaN while that is not known."""

    def _pointed(self) -> bool:
        return math.isfinite(self.value)

    pointed = AliasProperty(_pointed, bind=["value"], cache=True)
    """A direction is set."""

    def _located(self) -> bool:
        return math.isfinite(self.robot)

    located = AliasProperty(_located, bind=["robot"], cache=True)

    def _words(self) -> str:
        return heading_of(self.value)

    words = AliasProperty(_words, bind=["value"], cache=True)
    """The direction as a heading."""

    def _reach(self) -> float:
        return min(self.width, self.height) / 2 - dp(2)

    reach = AliasProperty(_reach, bind=["size"], cache=True)
    """Radius of the dial [px]."""

    def _disc(self) -> tuple[float, float, float]:
        return self.center_x - self.reach, self.center_y - self.reach, 2 * self.reach

    disc = AliasProperty(_disc, bind=["pos", "size"], cache=True)

    def _ray(self, yaw: float, first: float, last: float) -> list[float]:
        if not math.isfinite(yaw):
            return [self.center_x, self.center_y] * 2
        across, up = math.cos(yaw) * self.reach, math.sin(yaw) * self.reach
        x, y = self.center
        return [x + across * first, y + up * first, x + across * last, y + up * last]

    def _needle(self) -> list[float]:
        return self._ray(self.value, 0.3, 0.5)

    needle = AliasProperty(_needle, bind=["value", "pos", "size"], cache=True)

    def _knob(self) -> list[float]:
        return self._ray(self.value, 0.3, 0.56)[2:]

    knob = AliasProperty(_knob, bind=["value", "pos", "size"], cache=True)

    def _own(self) -> list[float]:
        if not math.isfinite(self.robot):
            return [self.center_x, self.center_y] * 3
        (x, y), ahead, aside = self.center, self.robot, math.pi / 2
        corners = ((0.72, 0.0, 0.0), (0.58, 0.085, aside), (0.58, 0.085, -aside))
        return [
            value
            for out, off, turn in corners
            for value in (
                x + self.reach * (out * math.cos(ahead) + off * math.cos(ahead + turn)),
                y + self.reach * (out * math.sin(ahead) + off * math.sin(ahead + turn)),
            )
        ]

    own = AliasProperty(_own, bind=["robot", "pos", "size"], cache=True)
    """Corners of the arrow that says where the robot points [px]."""

    def _robot_words(self) -> str:
        return (
            tr("robot {heading}").format(heading=heading_of(self.robot))
            if self.located and not self.pointed
            else ""
        )

    robot_words = AliasProperty(_robot_words, bind=["robot", "value"], cache=True)
    """What the arrow is, as in `robot 055°`; empty while that is not known, or the needle may lie there."""

    def __init__(self, **kwargs: Any) -> None:
        self._finger: int | None = None
        super().__init__(**kwargs)

    def show(self, msg: PoseWithCovarianceStamped) -> None:
        """Draw where the robot points."""
        self.robot = msg.pose.pose.orientation.yaw

    def rest(self) -> None:
        """Let the finger go; the direction stays."""
        self._finger = None

    def turn(self, x: float, y: float) -> None:
        """Point towards (x, y) [px] as a finger would, in steps of 5°."""
        if math.dist((x, y), self.center) < dp(12):
            return
        yaw = round(math.atan2(y - self.center_y, x - self.center_x) / STEP) * STEP
        if yaw != self.value:
            self.value = yaw
            self.dispatch("on_command", yaw)

    def on_touch_down(self, touch: Any) -> bool:
        """Take one finger on the dial."""
        near = math.dist(touch.pos, self.center) <= self.reach + dp(8)
        if self.disabled or self.state == "disabled" or self._finger is not None or not near:
            return False
        touch.grab(self)
        self._finger = touch.uid
        self.turn(*touch.pos)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Follow it."""
        if touch.grab_current is not self or touch.uid != self._finger:
            return False
        self.turn(*touch.pos)
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Let it go."""
        if touch.grab_current is not self:
            return False
        touch.ungrab(self)
        self._finger = None
        return True


def samples() -> dict[str, Callable[[], Widget]]:
    """Where it points, set, with the robot's own heading, disabled."""

    def make(**kwargs: Any) -> Callable[[], Widget]:
        return lambda: HeadingDial(**kwargs)

    return {
        "ahead": make(robot=math.radians(70)),
        "set": make(value=math.radians(-45), robot=math.radians(70)),
        "unknown": make(value=math.radians(90)),
        "disabled": make(value=0.0, state="disabled"),
    }
