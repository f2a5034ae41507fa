"""Wheel encoders: the speed of each wheel, and how far it has turned.

wheels = EncodersView(title="Encoders")
robot.on("/joint_states", wheels.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float64Array
from bridge.msgs.sensor_msgs import JointState
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import DASH
from widgets.core.language import figure, tr
from widgets.core.sensor_geometry import wheel_name
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["EncodersView", "samples"]

MAX_WHEELS = 4
"""Wheels that have room."""
MIN_FULL_SPEED = 5.0
"""Speed that a bar is at least made for [rad/s]: a creep is not drawn as full speed."""


class EncodersView(Gauge):
    """A bar for each wheel, to the right of its middle when it turns ahead."""

    accepts: ClassVar = (JointState,)
    grid_size: ClassVar = (3, 3)
    drawn_from: ClassVar = ("wheels", "full")

    wheels: ListProperty[tuple[str, float, float]] = ListProperty()
    """Name, speed [rad/s] and angle [rad] of each; NaN for what is not measured. Empty before the first."""
    full = NumericProperty(MIN_FULL_SPEED)
    """Speed of a full bar [rad/s]: the fastest that was seen."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Encoders"), **kwargs})

    def show(self, msg: JointState) -> None:
        """Show the newest angles and speeds."""
        self.wheels = [
            (wheel_name(name), round(_at(msg.velocity, number), 2), round(_at(msg.position, number), 2))
            for number, name in enumerate(msg.name)
        ]
        speeds = [abs(speed) for _, speed, _ in self.wheels if math.isfinite(speed)]
        self.full = max(self.full, *speeds) if speeds else self.full

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """A row for each wheel."""
        edge, shown = self.edge, self.wheels[:MAX_WHEELS]
        top = self.top - edge
        more = len(self.wheels) - len(shown)
        others = tr("{count} more").format(count=more)
        figures = (f"rad/s · {others}", others, f"+{more}") if more else ("rad/s",)
        if not self.low:
            yield from self.header(figures, "muted", told=False)
            top -= sp(12) + dp(4)
        if not shown:
            yield Word(DASH, self.center_x, (self.y + edge + top) / 2, sp(14), theme.muted)
            return
        said = not self.low and "rad/s" in first_fitting(figures, sp(13), self._beside_name(), bold=True)
        unit = "" if said else self._unit([figure(speed, 1) for _, speed, _ in shown])
        step = (top - self.y - edge) / len(shown)
        for number, wheel in enumerate(shown):
            yield from self._row(shapes, wheel, (top - (number + 0.5) * step, step), unit)

    def _beside_name(self) -> float:
        """Width that the header has for figures [px]."""
        return self.width - 2 * self.edge - wide(self.title.upper(), sp(11.5)) - dp(8)

    def _unit(self, figures: list[str]) -> str:
        """Behind each figure where there is no header to say it, or behind none."""
        room = self.width - 2 * self.edge - dp(16)
        widest = max(wide(f"{text} rad/s", sp(12), bold=True) for text in figures)
        return " rad/s" if widest <= room else ""

    def _row(
        self, shapes: Shapes, wheel: tuple[str, float, float], place: tuple[float, float], unit: str
    ) -> Iterator[Word]:
        (name, speed, angle), (middle, high) = wheel, place
        left, right = self.x + self.edge, self.right - self.edge
        roomy = high >= dp(22) and not self.low
        size = sp(12 if high >= dp(18) else 10)
        text_y = middle + (dp(5) if roomy else 0)
        shown = figure(speed, 1) + (unit if math.isfinite(speed) else "")
        yield Word(shown, right, text_y, size, theme.text, bold=True, anchor=(1, 0.5))
        names: tuple[str, ...] = (name, name[:1].upper())
        if roomy:
            names = (f"{name} · {_turns(angle)}", *names)
        label = first_fitting(names, size, right - left - dp(8) - wide(shown, size, bold=True))
        yield Word(label, left, text_y, size, theme.muted, anchor=(0, 0.5))
        if roomy:
            self._bar(shapes, speed, (left, right), text_y - size * 0.5 - dp(7))

    def _bar(self, shapes: Shapes, speed: float, span: tuple[float, float], y: float) -> None:
        left, right = span
        middle, half = (left + right) / 2, (right - left) / 2
        thick = dp(5)
        shapes.segments(np.array([[left, y]]), np.array([[right, y]]), thick, tint(theme.muted, 0.3))
        if math.isfinite(speed) and abs(speed) > 0.01:
            end = middle + half * max(-1.0, min(1.0, speed / self.full))
            shapes.segments(np.array([[middle, y]]), np.array([[end, y]]), thick, theme.accent)
        shapes.segments(
            np.array([[middle, y - dp(5)]]), np.array([[middle, y + dp(5)]]), dp(1.5), theme.muted
        )


def _at(values: Float64Array, number: int) -> float:
    """The value of that number; NaN where the message has fewer, as it may."""
    return float(values[number]) if number < len(values) else math.nan


def _turns(angle: float) -> str:
    return tr("{count} turns").format(count=figure(angle / math.tau, 1))


def _message(*wheels: tuple[str, float, float]) -> JointState:
    """Of wheels with name, speed [rad/s] and angle [rad]."""
    return JointState(
        name=[name for name, _, _ in wheels],
        position=Float64Array([angle for *_, angle in wheels]),
        velocity=Float64Array([speed for _, speed, _ in wheels]),
    )


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""
    usual = _message(("wheel_left_joint", 11.4, 812.5), ("wheel_right_joint", 14.3, 840.0))

    def made(
        msg: JointState | None = None, size: tuple[float, float] = (170, 112), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> EncodersView:
            view = EncodersView(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if msg:
                view.show(_message(("a", 20.0, 0.0)))
                view.show(msg)
            return view

        return build

    places = [f"{side}_{row}" for row in ("front", "middle", "rear") for side in ("left", "right")]
    six = _message(*((f"wheel_{place}_joint", 3.0, 9.0) for place in places))
    return {
        "never": made(),
        "live": made(usual, state="live"),
        "turning": made(
            _message(("wheel_left_joint", -6.0, -3.0), ("wheel_right_joint", 6.0, 3.0)), state="live"
        ),
        "not measured": made(
            _message(("wheel_left_joint", math.nan, 3.0), ("wheel_right_joint", 6.0, math.nan)), state="live"
        ),
        "six": made(six, state="live", size=(170, 150)),
        "low": made(usual, state="live", size=(120, 54)),
        "narrow": made(usual, state="live", size=(72, 54), card=False),
        "small": made(usual, state="live", size=(98, 76), card=False),
        "stale": made(usual, state="stale", age=2.0),
        "alarm": made(usual, state="alarm"),
        "disabled": made(usual, state="disabled"),
    }
