"""Switch for a bool of a robot: a tap asks for the other value, and it stands where the robot says it stands.

switch = ToggleSwitch(title="Lights")
robot.on("/lights/on", switch.show)
switch.bind(on_command=lambda _, msg: robot.publish("/lights/set", msg))
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from kivy.metrics import dp, sp
from kivy.uix.widget import Widget

from bridge.msgs.std_msgs import Bool
from widgets.controls.signals.bool_control import Switchable
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word
from widgets.core.icons import icon
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["ToggleSwitch"]

TRACK = 54, 30
"""Width and height of what the knob slides in [dp]."""


class ToggleSwitch(Switchable):
    """A track with a knob: filled and to the right for on, hollow and to the left for off, in the middle while not known."""

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The track with its knob at the right, the name and what is known at the left."""
        wide, high = dp(TRACK[0]), dp(TRACK[1])
        left, y = self.right - self.edge - wide - dp(28 if self.alarmed else 4), self.center_y
        ends = np.array([(left + high / 2, y), (left + wide - high / 2, y)])
        wanted = self.value if self.asked is None else self.asked
        done = bool(wanted) and self.asked is None  # what is only asked for is not filled
        rim = theme.accent if done or self.asked is not None else theme.line
        for width, colour in ((high, rim), (high - 2 * dp(1.5), theme.accent if done else theme.surface)):
            shapes.line(ends, width, colour)
            for end in ends:
                shapes.disc(float(end[0]), float(end[1]), width / 2, colour)
        share = 0.5 if wanted is None else float(wanted)
        at = left + high / 2 + share * (wide - high)
        knob = theme.ink_accent if done else theme.muted if self.asked is None else theme.accent
        shapes.disc(at, y, high / 2 - dp(4), knob)
        if self.pressed:
            shapes.ring(at, y, high / 2 + dp(3), dp(2), theme.accent)
        if done:
            yield Word(icon("check"), at, y, sp(16), theme.accent, font=theme.icons)
        yield from self.names(self.x + self.edge + dp(2), left - dp(10))

    def names(self, left: float, right: float) -> Iterator[Word]:
        """The name over what is known of it, between `left` and `right` [px]."""
        room, y = right - left, self.center_y
        if self.title:
            size = fitting_size([self.title], sp(16), room, bold=True)
            yield Word(self.title, left, y + sp(9), size, theme.text, bold=True, anchor=(0, 0.5))
        yield Word(
            self.word,
            left,
            y - (sp(11) if self.title else 0),
            fitting_size([self.word], sp(14), room),
            theme.roles[self.role],
            anchor=(0, 0.5),
        )


def samples() -> dict[str, Callable[[], Widget]]:
    """On, off, asked for, without an answer, every state."""

    def make(value: bool | None = None, **more: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            switch = ToggleSwitch(size_hint=(None, None), size=(dp(240), dp(72)), title="Lights", **more)
            if value is not None:
                switch.show(Bool(value))
            return switch

        return build

    def asked() -> Widget:
        switch = ToggleSwitch(size_hint=(None, None), size=(dp(240), dp(72)), title="Lights", value=False)
        switch.ask(True)
        return switch

    return {
        "never": make(state="never"),
        "on": make(True),
        "off": make(False),
        "asked": asked,
        "no reply": make(False, outcome="no_reply"),
        "stale": make(True, state="stale", age=5.0),
        "alarm": make(True, state="alarm"),
        "disabled": make(True, state="disabled"),
        "pressed": make(False, pressed=True),
    }
