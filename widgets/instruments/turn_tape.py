"""Turn rate, bank and pitch of a robot on three scales: how fast it turns, how far it leans, where its bow points up or down.

tape = TurnTape()
robot.on("/imu/data", tape.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import NumericProperty
from kivy.uix.widget import Widget
from numpy.typing import NDArray

from bridge.msgs.geometry_msgs import Quaternion, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu
from widgets.core.canvas_ink import Ink, Word, tint
from widgets.core.geometry import steady
from widgets.core.icons import icon
from widgets.core.language import DASH, figure, mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["TurnTape"]

SEEN_RATE, SEEN_LEAN = 0.1, 0.1
"""Changes that are less are not seen [deg/s], [deg]."""
_TURN, _BANK, _PITCH = mark("Turn"), mark("Bank"), mark("Pitch")
_SIDES = {
    "Turn": (mark("left"), mark("right")),
    "Bank": (mark("left"), mark("right")),
    "Pitch": (mark("up"), mark("down")),
}
"""Of each scale, what is said of a value above 0, and below."""


class TurnTape(Gauge):
    """Three scales with zero in the middle: a bar for the turn, pointers for bank and pitch. What is far is marked at its end."""

    accepts: ClassVar = (Imu, Odometry)
    specificity: ClassVar = 0.3
    grid_size: ClassVar = (4, 3)
    drawn_from: ClassVar = ("turn_rate", "bank", "pitch", "max_turn_rate", "max_lean", "warn_lean")

    turn_rate = NumericProperty(math.nan)
    """About the vertical [deg/s], to the left above 0; NaN when not known."""
    bank = NumericProperty(math.nan)
    """To the left above 0 [deg]; NaN when not known."""
    pitch = NumericProperty(math.nan)
    """Bow up above 0 [deg]; NaN when not known."""
    max_turn_rate = NumericProperty(60.0)
    """At the ends of the scale of turning [deg/s], above 0."""
    max_lean = NumericProperty(30.0)
    """At the ends of the scales of bank and pitch [deg], above 0."""
    warn_lean = NumericProperty(20.0)
    """From here on a lean is marked as much [deg]."""

    def __init__(self, **kwargs: Any) -> None:
        self._still = Ink()
        self._still_look: tuple[object, ...] = ()
        super().__init__(**kwargs)
        self.canvas.insert(self.canvas.indexof(self._ink), self._still)
        self.veil_radius = self.card_corner

    def show(self, msg: Imu | Odometry) -> None:
        """Take turn rate and attitude; an Imu that measures no orientation, or no turn, leaves that unknown."""
        if isinstance(msg, Imu):
            turns, way = msg.angular_velocity, msg.orientation
            turning = msg.angular_velocity_covariance[0] != -1.0
            leaning = msg.orientation_covariance[0] != -1.0
        else:
            turns, way, turning = msg.twist.twist.angular, msg.pose.pose.orientation, True
            leaning = True
        leaning = leaning and bool(way.x or way.y or way.z or way.w)
        rate = math.degrees(turns.z) if turning else math.nan
        # in REP-103 a roll above 0 leans to the right, and a pitch above 0 has the bow down
        bank = -math.degrees(way.roll) if leaning else math.nan
        pitch = -math.degrees(way.pitch) if leaning else math.nan
        self.turn_rate = steady(self.turn_rate, rate, SEEN_RATE)
        self.bank = steady(self.bank, bank, SEEN_LEAN)
        self.pitch = steady(self.pitch, pitch, SEEN_LEAN)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """The scales one below the other; where there is little height, that of turning alone."""
        rows = [
            (_TURN, self.turn_rate, self.max_turn_rate, "°/s", math.inf),
            (_BANK, self.bank, self.max_lean, "°", self.warn_lean),
            (_PITCH, self.pitch, self.max_lean, "°", self.warn_lean),
        ]
        inner = self.height - 2 * self.edge
        fitting = max(1, min(3, int(inner / sp(34))))
        high = min(inner / fitting, dp(64))
        middles = [self.top - self.edge - (row + 0.5) * inner / fitting for row in range(fitting)]
        self._draw_still([middle - high * 0.2 for middle in middles])
        for middle, row in zip(middles, rows, strict=False):
            yield from self._row(shapes, middle, high, row)

    def _ends(self) -> tuple[float, float]:
        """Of the scales [px]; an alarm has its sign behind them."""
        right = self.right - self.edge - (dp(20) if self.alarmed else 0)
        return self.x + self.edge + dp(4), right - dp(4)

    def _draw_still(self, places: list[float]) -> None:
        """Ticks and lines of the scales at these heights [px]: most messages leave them as they are."""
        look = (*places, *self._ends(), theme.name, dp(1))
        if look == self._still_look:
            return
        self._still_look = look
        shapes = Shapes()
        for y in places:
            _ticks(shapes, self._ends(), y)
        self._still.fill(shapes)

    def _row(
        self, shapes: Shapes, y: float, high: float, row: tuple[str, float, float, str, float]
    ) -> Iterator[Word]:
        name, value, most, unit, warns = row
        known = self.state != "never" and math.isfinite(value)
        start, end = self._ends()
        left, right = start - dp(4), end + dp(4)
        text_y, scale_y = y + high * 0.24, y - high * 0.2
        much = known and abs(value) >= warns
        role = theme.warn if much else theme.text if known else theme.muted
        said = self._said(name, value if known else math.nan, unit)
        title = tr(name).upper()
        yield Word(title, left, text_y, sp(11.5), theme.muted, anchor=(0, 0.5))
        sign = dp(22) if much else 0.0
        room = right - left - wide(title, sp(11.5)) - dp(8) - sign
        shown = first_fitting(said, sp(15), room, bold=True)
        yield Word(shown, right, text_y, sp(15), role, bold=True, anchor=(1, 0.5))
        if much:  # a lean is no lean by its colour alone
            at = right - wide(shown, sp(15), bold=True) - dp(13)
            yield Word(icon("warning_fill"), at, text_y, sp(17), role, font=theme.icons)
        if known:
            self._pointer(shapes, (start, end), scale_y, value / most, name, much)

    def _said(self, name: str, value: float, unit: str) -> tuple[str, ...]:
        """The figure with its side, without, longest first."""
        if not math.isfinite(value):
            return (DASH,)
        text = f"{figure(abs(value), 0)}{unit}"
        plus, minus = _SIDES[name]
        side = "" if text.startswith("0") else tr(plus if value > 0 else minus)
        return (f"{text} {side}".strip(), text)

    def _pointer(
        self, shapes: Shapes, ends: tuple[float, float], y: float, share: float, name: str, much: bool
    ) -> None:
        """Zero is in the middle; a value above 0 is to the left, as the robot turns and leans, and pitch to the right."""
        middle, half = (ends[0] + ends[1]) / 2, (ends[1] - ends[0]) / 2
        colour = tuple(theme.warn if much else theme.accent)
        limited = min(max(share, -1.0), 1.0)
        at = middle + half * (limited if name == _PITCH else -limited)
        if name == _TURN:
            if abs(at - middle) > dp(1):
                shapes.line(np.array([(middle, y), (at, y)]), dp(7), colour)
            shapes.stamp(_stamp("zero", tuple(theme.text), dp(1)), middle, y)
        if abs(share) > 1.0:
            shapes.stamp(_stamp("right" if at > middle else "left", colour, dp(1)), at, y)
        elif name != _TURN:
            shapes.stamp(_stamp("pointer", colour, dp(1)), at, y)


def _ticks(shapes: Shapes, ends: tuple[float, float], y: float) -> None:
    """Nine on a line, longer ones in the middle and at both ends."""
    start, end = ends
    places = (start + end) / 2 + (end - start) / 2 * np.linspace(-1.0, 1.0, 9)
    length = np.where(np.arange(9) % 4 == 0, dp(11), dp(6))
    low = np.stack([places, y - length / 2], axis=1)
    shapes.segments(low, low + np.stack([np.zeros(9), length], axis=1), dp(1.6), tint(theme.muted, 0.8))
    shapes.line(np.array([(start, y), (end, y)]), dp(1.4), theme.line)


@lru_cache(maxsize=64)
def _stamp(
    kind: str, colour: tuple[float, ...], unit: float
) -> tuple[NDArray[np.float32], NDArray[np.uint16]]:
    """Vertices and indices of a mark at (0, 0), a dp being `unit` pixels; beyond the scale an arrow points on."""
    shapes = Shapes()
    if kind == "zero":
        shapes.line(np.array([(0.0, -8.0), (0.0, 8.0)]) * unit, 2.4 * unit, colour)
    elif kind == "pointer":
        shapes.polygon([(0.0, unit), (-7 * unit, -11 * unit), (7 * unit, -11 * unit)], colour)
        shapes.line(np.array([(0.0, 0.0), (0.0, 7.0)]) * unit, 2.4 * unit, colour)
    else:
        way = unit if kind == "right" else -unit
        shapes.polygon([(5 * way, 0.0), (-7 * way, 8 * unit), (-7 * way, -8 * unit)], colour)
    return shapes.arrays()


def samples() -> dict[str, Callable[[], Widget]]:
    """Level, turning, leaning far, every state, little room."""

    def make(
        rate: float, bank: float, pitch: float, size: tuple[float, float] = (320, 150), **more: Any
    ) -> Any:
        def build() -> Widget:
            tape = TurnTape(
                size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **{"state": "live", **more}
            )
            if math.isfinite(rate):
                tape.show(_leaning(rate, bank, pitch))
            return tape

        return build

    return {
        "never": make(math.nan, 0, 0, state="never"),
        "live": make(18, 6, -4),
        "level": make(0, 0, 0),
        "to the right": make(-35, -12, 9),
        "much": make(95, 24, -33),
        "one scale": make(18, 6, -4, (320, 60)),
        "narrow": make(-18, 6, -4, (160, 150)),
        "stale": make(18, 6, -4, state="stale", age=4.0),
        "alarm": make(18, 26, -4, state="alarm"),
        "disabled": make(18, 6, -4, state="disabled"),
    }


def _leaning(rate: float, bank: float, pitch: float) -> Imu:
    """What an Imu tells of such a turn [deg/s] and lean [deg]."""
    roll, nose = -math.radians(bank) / 2, -math.radians(pitch) / 2
    way = Quaternion(
        math.sin(roll) * math.cos(nose),
        math.cos(roll) * math.sin(nose),
        -math.sin(roll) * math.sin(nose),
        math.cos(roll) * math.cos(nose),
    )
    return Imu(orientation=way, angular_velocity=Vector3(0.0, 0.0, math.radians(rate)))
