"""Steering of a truck seen from above: the steered wheels, the speed of each, and the path they lead to.

drive = AckermannView(title="Steering")
robot.on("/ackermann", drive.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar, NamedTuple

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import ListProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import AckermannState
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import DASH, Points, rounded
from widgets.core.language import figure, tr
from widgets.core.quantities import said
from widgets.core.sensor_geometry import away_text
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["AckermannView", "samples"]

WIDE = 1.25
"""A card this many times broader than high has its figures beside the truck."""
STRAIGHT = 200.0
"""A turn of a greater radius is as good as none [m]."""
STRAIGHT_STEER = math.radians(0.5)
"""Less is not called a direction [rad]."""
TRACK, WHEEL, AHEAD, BEHIND = 0.62, 0.3, 0.3, 0.26
"""Between the wheels, a wheel's length, and how far the body goes beyond its axles, in wheelbases."""
LONG, ROOM = 1.25, 0.2
"""How far the way is drawn beyond an axle, and what is kept free for it before and behind the body, in wheelbases."""
MIN_WHEELBASE = 44
"""The speeds of the wheels give way before the truck gets smaller [dp]."""
MAX_WHEELS = 8
"""Wheels that are drawn."""
WHEELS = ("rear_left", "rear_right", "front_left", "front_right")
UNKNOWN = tuple((name, math.nan, math.nan) for name in WHEELS)
"""Drawn before the first message."""


class _Truck(NamedTuple):
    """Where the truck is drawn."""

    x: float
    rear: float
    """Height of the rear axle on the screen [px]."""
    base: float
    """Wheelbase [px]."""


class AckermannView(Gauge):
    """The truck's bow is up; its wheels are turned as they are, and their speeds stand beside them."""

    accepts: ClassVar = (AckermannState,)
    drawn_from: ClassVar = ("speed", "steering", "radius", "wheels")

    speed = NumericProperty(math.nan)
    """Of the middle of the rear axle, ahead [m/s]; NaN when not known."""
    steering = NumericProperty(math.nan)
    """Of a wheel in the middle of the front axle [rad], positive left; NaN when not known."""
    radius = NumericProperty(math.nan)
    """Of the turn [m], positive left; infinite straight ahead, NaN when not known."""
    wheels: ListProperty[tuple[str, float, float]] = ListProperty()
    """Name, angle [rad] and speed at the rim [m/s] of each; NaN for what is not measured."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Steering"), **kwargs})

    def show(self, msg: AckermannState) -> None:
        """Show the newest state."""
        self.speed, self.steering = round(msg.speed, 2), round(msg.steering, 3)
        self.radius = round(msg.turning_radius, 1)
        self.wheels = [
            (name, round(_at(msg.wheel_angles, number), 3), round(_at(msg.wheel_speeds, number), 1))
            for number, name in enumerate(msg.wheels[:MAX_WHEELS])
        ]

    @property
    def steer_words(self) -> str:
        """How far it steers, as in `12° left`; `straight`, or a dash."""
        if not math.isfinite(self.steering):
            return DASH
        if abs(self.steering) < STRAIGHT_STEER:
            return tr("straight")
        return f"{abs(math.degrees(self.steering)):.0f}° {tr('left') if self.steering > 0 else tr('right')}"

    @property
    def radius_words(self) -> str:
        """Of the turn, as in `9.4 m`; `none` straight ahead, or a dash."""
        if math.isnan(self.radius):
            return DASH
        return tr("none", "radius") if abs(self.radius) > STRAIGHT else away_text(abs(self.radius))

    @property
    def speed_words(self) -> str:
        """As in `1.8 m/s`, negative astern."""
        told = said(self.speed, "speed", 1)
        return f"{told.text} {told.unit}" if math.isfinite(self.speed) else DASH

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The truck with its way and its wheels, and the figures."""
        if self.low:
            yield from self._brief()
            return
        edge = self.edge
        left, low, right, top = self.x + edge, self.y + edge, self.right - edge, self.top - edge
        beside = self.width > WIDE * self.height
        if beside:
            column = max(dp(88), (right - left) * 0.34)
            yield from self._column((right - column, low, column, top - low))
            right -= column + dp(6)
            yield Word(self.title.upper(), left, top - sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
        else:
            yield from self.header((self.steer_words,))
            yield from self._footer(left, low, right)
            low += sp(18)
        top -= sp(18)
        yield from self._draw_truck(shapes, (left, low, right - left, top - low))

    def _footer(self, left: float, low: float, right: float) -> Iterator[Word]:
        """Speed and radius in one line, the speed alone where both do not fit."""
        y, size = low + sp(6), sp(13)
        yield Word(self.speed_words, left, y, size, theme.text, bold=True, anchor=(0, 0.5))
        room = right - left - wide(self.speed_words, size, bold=True) - dp(10)
        turn = (
            tr("no turn")
            if abs(self.radius) > STRAIGHT
            else tr("radius {radius}").format(radius=self.radius_words)
        )
        brief = "" if not abs(self.radius) <= STRAIGHT else f"r {self.radius_words}"
        yield Word(first_fitting((turn, brief), size, room), right, y, size, theme.muted, anchor=(1, 0.5))

    def _column(self, box: tuple[float, float, float, float]) -> Iterator[Word]:
        """Three figures under their names, or as many as there is height for."""
        left, low, width, height = box
        lines = min(3, max(1, int(height / sp(35))))
        step = height / lines
        size = sp(22 if height >= dp(170) else 17)
        turned = self.alarmed and dp(16)  # an alarm has its sign in the corner
        figures = (
            (tr("Speed"), self.speed_words),
            (tr("Steer"), self.steer_words),
            (tr("Radius"), self.radius_words),
        )
        for number, (name, text) in enumerate(figures[:lines]):
            top = low + height - number * step
            value, _, unit = text.partition(" ") if text[0].isdigit() or text[0] in "-−" else (text, "", "")
            yield Word(name.upper(), left, top - sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
            room = width - (turned if number == 0 else 0)
            unit_size = fitting_size([unit], sp(13), width * 0.45)
            fitted = fitting_size([value], size, room - wide(unit, unit_size) - dp(4), bold=True)
            y = top - sp(16) - size * 0.5
            yield Word(value, left, y, fitted, theme.text, bold=True, anchor=(0, 0.5))
            after = left + wide(value, fitted, bold=True) + dp(4)
            yield Word(unit, after, y - (fitted - unit_size) * 0.3, unit_size, theme.muted, anchor=(0, 0.5))

    def _draw_truck(self, shapes: Shapes, box: tuple[float, float, float, float]) -> Iterator[Word]:
        """As large as it and its figures beside it fit into the box."""
        left, low, width, height = box
        high, across = 1 + AHEAD + BEHIND + 2 * ROOM, TRACK + WHEEL * 0.6
        base = min(height / high, (width - 2 * (sp(30) + dp(6))) / across, dp(190))
        told = bool(self.wheels) and base >= dp(MIN_WHEELBASE)
        if not told:
            base = max(min(height / high, width / across, dp(190)), dp(12))
        x = left + width / 2
        truck = _Truck(x, low + (height - base * high) / 2 + base * (BEHIND + ROOM), base)
        self._draw_way(shapes, truck, box)
        half = base * TRACK / 2
        body = rounded(
            x - half * 0.72, truck.rear - base * BEHIND, half * 1.44, base * (1 + AHEAD + BEHIND), base * 0.14
        )
        shapes.polygon([(a, b) for a, b in body], tint(theme.raised, 0.9))
        shapes.line(np.array([*body, body[0]]), dp(1.5), tint(theme.muted, 0.8))
        cabin = truck.rear + base * 0.78
        shapes.segments(
            np.array([[x - half * 0.6, cabin]]), np.array([[x + half * 0.6, cabin]]), dp(1.5), theme.muted
        )
        for y in (truck.rear, truck.rear + base):
            shapes.segments(np.array([[x - half, y]]), np.array([[x + half, y]]), dp(3), theme.muted)
        for wheel in self.wheels or UNKNOWN:
            word = self._draw_wheel(shapes, truck, wheel)
            if told and word is not None:
                ground(shapes, word, tint(theme.surface, 0.8))
                yield word

    def _draw_wheel(self, shapes: Shapes, truck: _Truck, wheel: tuple[str, float, float]) -> Word | None:
        """One wheel, turned as it is; gives its speed as a word. None where the name does not say which it is."""
        name, angle, speed = wheel
        side, row = _side_of(name)
        if not side:
            return None
        x, y = truck.x - side * truck.base * TRACK / 2, truck.rear + truck.base * row
        turned = angle if math.isfinite(angle) else 0.0
        ahead = np.array([-math.sin(turned), math.cos(turned)]) * truck.base * WHEEL / 2
        ends = np.array([x, y]) + np.array([[-1], [1]]) * ahead
        thick = max(truck.base * 0.13, dp(6))
        steered = row and abs(turned) >= STRAIGHT_STEER
        ink = theme.accent if steered else theme.text if self.wheels else theme.faint
        shapes.line(ends, thick + dp(3), theme.surface)
        shapes.line(ends, thick, ink)
        size = sp(13 if truck.base >= dp(90) else 11.5)
        away = truck.base * WHEEL * 0.3 + thick * 0.5 + dp(5)
        text = figure(speed, 1) if math.isfinite(speed) else DASH
        return Word(text, x - side * away, y, size, theme.text, anchor=((1 + side) / 2, 0.5))

    def _draw_way(self, shapes: Shapes, truck: _Truck, box: tuple[float, float, float, float]) -> None:
        """Where the wheels of the rear axle go if it steers on so, ahead or, when it backs, behind."""
        if not math.isfinite(self.steering):
            return
        left, low, width, height = box
        curve = math.tan(max(-1.2, min(1.2, self.steering))) / truck.base
        back = self.speed < -0.05
        along = np.linspace(0.0, truck.base * (1 + LONG) * (-1 if back else 1), 40)
        for side in (-1, 1):
            line = _bent(along, curve, side * truck.base * TRACK / 2) + np.array(truck[:2])
            inside = (line[:, 0] > left) & (line[:, 0] < left + width)
            inside &= (line[:, 1] > low - dp(2)) & (line[:, 1] < low + height + dp(2))
            count = len(line) if inside.all() else int(np.argmin(inside))
            if count > 1:
                shapes.dashes(line[:count], dp(3), tint(theme.plan, 0.9), period=dp(9), dash=dp(4))

    def _brief(self) -> Iterator[Word]:
        """Speed over steering."""
        low, room = self.y + self.edge + sp(7), self.width - 2 * self.edge
        speed = first_fitting((self.speed_words, self.speed_words.partition(" ")[0]), sp(15), room, bold=True)
        yield Word(speed, self.center_x, low + sp(18), sp(15), theme.text, bold=True)
        yield Word(first_fitting((self.steer_words,), sp(11), room), self.center_x, low, sp(11), theme.muted)


def _bent(along: Points, curve: float, aside: float) -> Points:
    """Places along an arc of curvature `curve` [1/px] that begins straight up, `aside` to the right of it."""
    turned = along * curve
    if abs(curve) < 1e-6:
        return np.stack([np.full_like(along, aside), along], axis=1)
    x, y = -(1 - np.cos(turned)) / curve, np.sin(turned) / curve
    return np.stack([x + aside * np.cos(turned), y + aside * np.sin(turned)], axis=1)


def _side_of(name: str) -> tuple[int, int]:
    """Side, 1 left, -1 right, 0 unknown, and axle, 1 front, 0 rear, by the words in a wheel's name."""
    words = name.lower()
    side = 1 if "left" in words else -1 if "right" in words else 0
    return side, int("front" in words)


def _at(values: Float64Array, number: int) -> float:
    """The value of that number; NaN where the message has fewer, as it may."""
    return float(values[number]) if number < len(values) else math.nan


def _state(speed: float, degrees: float) -> AckermannState:
    """Of a truck with a wheelbase of 2 m and a track of 1.2 m."""
    steering = math.radians(degrees)
    curve = math.tan(steering) / 2.0
    inner, outer = (math.atan(2.0 * curve / (1 - curve * aside)) for aside in (0.6, -0.6))
    rims = [speed * (1 - curve * aside) for aside in (0.6, -0.6)]
    fronts = [speed * math.hypot(1 - curve * aside, curve * 2.0) for aside in (0.6, -0.6)]
    return AckermannState(
        speed=speed,
        steering=steering,
        turning_radius=1 / curve if abs(curve) > 1e-6 else math.inf,
        wheels=list(WHEELS),
        wheel_angles=Float64Array((0.0, 0.0, inner, outer)),
        wheel_speeds=Float64Array([*rims, *fronts]),
    )


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""
    usual = _state(1.8, -12.0)

    def made(
        msg: AckermannState | None = None, size: tuple[float, float] = (176, 176), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> AckermannView:
            view = AckermannView(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if msg:
                view.show(msg)
            return view

        return build

    large = (326, 228)
    return {
        "never": made(),
        "live": made(usual, state="live"),
        "straight": made(_state(4.2, 0.0), state="live"),
        "hard left": made(_state(1.0, 29.8), state="live"),
        "backing": made(_state(-0.8, 20.0), state="live"),
        "not measured": made(AckermannState(speed=math.nan, wheels=list(WHEELS)), state="live"),
        "large": made(usual, large, state="live"),
        "large hard left": made(_state(1.0, 29.8), large, state="live"),
        "large never": made(size=large),
        "short": made(usual, (212, 148), state="live"),
        "huge": made(usual, (420, 440), state="live"),
        "narrow": made(usual, (98, 132), state="live", card=False),
        "low": made(usual, (120, 54), state="live"),
        "low and narrow": made(usual, (72, 54), state="live", card=False),
        "stale": made(usual, large, state="stale", age=2.0),
        "alarm": made(usual, large, state="alarm"),
        "disabled": made(usual, state="disabled"),
    }
