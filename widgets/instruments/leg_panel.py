"""Legs of a walker or swimmer: the angle of each one and the temperature of its motor.

legs = LegPanel()
robot.on("/joint_states", legs.show)
robot.on("/motors", legs.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, DictProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import MotorArray
from bridge.msgs.sensor_msgs import JointState
from widgets.core.canvas_ink import Word
from widgets.core.geometry import DASH, dial_point
from widgets.core.icons import icon
from widgets.core.language import figure, mark, tr
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["LegPanel", "leg_of", "samples"]

SIDES = {"left": mark("L", "left"), "right": mark("R", "right")}
ROWS = {"front": 1, "fore": 1, "middle": 2, "mid": 2, "rear": 3, "back": 3, "hind": 3}
USUAL = ("L1", "L2", "L3", "R1", "R2", "R3")
"""Legs that are drawn before the first report."""
GAP = 0.3
"""Between the figures of a leg, of the height of their type."""
MAX_LEGS = 8
"""Legs that have room."""


def leg_of(name: str) -> str:
    """What people call the leg of a joint or motor: `L2` for `middle_left_leg_joint`; empty for what is no leg."""
    words = name.lower().split("_")
    side = next((SIDES[word] for word in words if word in SIDES), "")
    row = next((ROWS[word] for word in words if word in ROWS), 0)
    return f"{side}{row}" if side and row else ""


def leg_words(leg: str) -> str:
    """A name of `leg_of` with the letter of the side that the language has."""
    return f"{tr(leg[:1], 'left' if leg[:1] == SIDES['left'] else 'right')}{leg[1:]}"


class LegPanel(Gauge):
    """A dial for each leg, left ones above right ones, the front at the left; up is an angle of 0, clockwise more."""

    accepts: ClassVar = (JointState, MotorArray)
    shown_beside: ClassVar = (MotorArray,)
    specificity: ClassVar = 0.3
    drawn_from: ClassVar = ("angles", "temperatures", "warm", "hot")

    angles = DictProperty()
    """Of each leg that has reported one, -179 to 180 [deg]; NaN for what is not measured."""
    temperatures = DictProperty()
    """Of each leg's motor [degC]; NaN for what is not measured."""
    warm = NumericProperty(45.0)
    """From here on a motor is too warm to go on like this for long [degC]."""
    hot = NumericProperty(60.0)
    """From here on it must rest [degC]."""

    def _legs(self) -> list[str]:
        return sorted({*self.angles, *self.temperatures} or set(USUAL))[:MAX_LEGS]

    legs = AliasProperty(_legs, bind=["angles", "temperatures"])
    """Their names, `L1` to `R3`."""

    def _hottest(self) -> str:
        known = {leg: value for leg, value in self.temperatures.items() if math.isfinite(value)}
        return max(known, key=lambda leg: known[leg], default="")

    hottest = AliasProperty(_hottest, bind=["temperatures"])
    """The leg with the warmest motor; empty while none is known."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Legs"), **kwargs})

    def show(self, msg: JointState | MotorArray) -> None:
        """Take the angles, or the temperatures, of those joints or motors that are legs; the others are left alone."""
        if isinstance(msg, JointState):
            names, values, scale = msg.name, msg.position, 180 / math.pi
        else:
            names, values, scale = msg.names, msg.temperatures, 1.0
        told = {leg: _at(values, number, scale) for number, leg in enumerate(map(leg_of, names)) if leg}
        if isinstance(msg, JointState):
            told = {leg: _turned(angle) for leg, angle in told.items()}
        held = self.angles if isinstance(msg, JointState) else self.temperatures
        if told and not _same(held, told):
            held.update(told)

    def role(self, leg: str) -> str:
        """Role of the colour of a leg's temperature: `muted`, `warn` or `danger`."""
        told = self.temperatures.get(leg, math.nan)
        return "danger" if told >= self.hot else "warn" if told >= self.warm else "muted"

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """All dials with their figures, and which motor is too warm."""
        if self.low:
            yield self._brief()
            return
        worst = self.hottest
        role = self.role(worst) if worst else "muted"
        word = {"danger": tr("hot"), "warn": tr("warm")}.get(role, "")
        named = leg_words(worst) if worst else ""
        said = (tr("{leg} is {word}").format(leg=named, word=word), f"{named} {word}", word)
        yield from self.header(said if word else (), role)
        top, legs = self.top - self.edge - sp(12) - dp(6), self.legs
        columns, rows = self._grid(len(legs), top - self.y - self.edge)
        across = (self.width - 2 * self.edge) / columns
        high = (top - self.y - self.edge) / rows
        upright = columns < rows
        for number, leg in enumerate(legs):
            column, row = divmod(number, rows) if upright else reversed(divmod(number, columns))
            x = self.x + self.edge + (column + 0.5) * across
            yield from self._cell(shapes, leg, (x, top - row * high, across, high))

    def _grid(self, count: int, high: float) -> tuple[int, int]:
        """Columns and rows: sides above each other, beside each other where it is narrow, all in a row where it is low."""
        half = math.ceil(count / 2)
        room = self.width - 2 * self.edge
        if room > 3.2 * high and room / count >= dp(44):
            return count, 1
        return (2, half) if room < 0.75 * high else (half, 2)

    def _cell(self, shapes: Shapes, leg: str, box: tuple[float, float, float, float]) -> Iterator[Word]:
        x, top, across, high = box
        size = sp(16 if across >= dp(136) else 13 if across >= dp(88) else 12 if across >= dp(64) else 11)
        line = size * 1.25
        parts = self._figures(leg)
        lines = [parts] if _long(parts, size) <= across - dp(4) else [parts[:2], parts[2:]]
        if len(lines) > 1 and high - 2 * line < dp(36):
            lines = [[parts[0], parts[-1]]]  # the dial says the angle too
        longest = max(_long(row, size) for row in lines)
        size *= min(1.0, (across - dp(4)) / longest)
        words = len(lines) * line
        radius = max(min((across - dp(8)) / 2, (high - words - dp(8 if high >= dp(60) else 3)) / 2), dp(8))
        over = max(high - words - 2 * radius, 0.0) / 2
        y = top - over - radius
        self._dial(shapes, leg, (x, y, radius))
        role = self.role(leg)
        if role != "muted" and radius >= dp(14):
            sign = icon("warning_fill" if role == "danger" else "thermostat")
            at = x + radius * 0.86 + dp(1), y + radius * 0.8
            shapes.disc(*at, dp(9), theme.surface)
            yield Word(sign, *at, sp(15), theme.roles[role], font=theme.icons)
        for number, row in enumerate(lines):
            low = y - radius - dp(2) - (number + 0.5) * line
            yield from self._line(row, x, low, size)

    def _line(self, parts: list[tuple[str, str, bool]], x: float, y: float, size: float) -> Iterator[Word]:
        left = x - _long(parts, size) / 2
        for text, role, bold in parts:
            yield Word(text, left, y, size, theme.roles[role], bold=bold, anchor=(0, 0.5))
            left += wide(text, size, bold=bold) + size * GAP

    def _figures(self, leg: str) -> list[tuple[str, str, bool]]:
        """Name, angle and temperature of a leg: text, role, whether it is bold."""
        angle, warmth = self.angles.get(leg, math.nan), self.temperatures.get(leg, math.nan)
        turned = f"{figure(angle, 0)}°" if math.isfinite(angle) else DASH
        told = f"{figure(warmth, 0)} °C" if math.isfinite(warmth) else DASH
        role = self.role(leg)
        if turned == told == DASH:
            return [(leg, "muted", True), (DASH, "muted", False)]
        return [(leg, "text", True), (turned, "text", False), (told, role, role != "muted")]

    def _dial(self, shapes: Shapes, leg: str, place: tuple[float, float, float]) -> None:
        x, y, radius = place
        role = self.role(leg)
        rim = theme.line if role == "muted" else theme.roles[role]
        thick = max(dp(2), radius * 0.09)
        shapes.disc(x, y, radius, theme.raised)
        shapes.ring(x, y, radius - thick / 2, thick, rim)
        angle = self.angles.get(leg, math.nan)
        if math.isfinite(angle):
            end = dial_point(angle, radius * 0.84)
            points = np.array([[x, y], [x + end[0], y + end[1]]])
            shapes.line(points, max(dp(3), radius * 0.15), theme.accent)
            shapes.disc(x + end[0], y + end[1], max(dp(3), radius * 0.15) / 2, theme.accent)
        shapes.disc(x, y, max(dp(2.5), radius * 0.14), theme.text if math.isfinite(angle) else theme.faint)

    def _brief(self) -> Word:
        """The warmest motor in a line."""
        leg = self.hottest
        if not leg:
            return Word(DASH, self.center_x, self.center_y, sp(14), theme.muted)
        role = self.role(leg)
        told = f"{figure(self.temperatures[leg], 0)} °C"
        named = f"{leg_words(leg)} {told}"
        texts = (tr("legs · {leg}").format(leg=named), named, told)
        text = first_fitting(texts, sp(14), self.width - 2 * self.edge, bold=True)
        return Word(text, *self.center, sp(14), theme.roles["text" if role == "muted" else role], bold=True)


def _long(parts: list[tuple[str, str, bool]], size: float) -> float:
    """Width of a line of figures [px]."""
    return sum(wide(text, size, bold=bold) + size * GAP for text, _, bold in parts) - size * GAP


def _at(values: Float64Array, number: int, scale: float) -> float:
    """Rounded to what is shown; NaN where the message has fewer, as it may."""
    told = float(values[number]) * scale if number < len(values) else math.nan
    return round(told) if math.isfinite(told) else math.nan


def _turned(angle: float) -> float:
    """The same direction from -179 to 180 [deg]: a fin turns on and on."""
    return 180.0 - (180.0 - angle) % 360.0


def _same(held: dict[str, float], told: dict[str, float]) -> bool:
    """Whether nothing would look different."""
    return all(
        leg in held and (held[leg] == value or (math.isnan(held[leg]) and math.isnan(value)))
        for leg, value in told.items()
    )


PLACES = [f"{row}_{side}" for side in ("left", "right") for row in ("front", "middle", "rear")]


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the panel by name."""
    angles, warmth = (22, -38, 12, -20, 41, -9), (34.0, 36.0, 52.0, 33.0, 63.0, 35.0)

    def made(
        turned: tuple[float, ...] = angles,
        warm: tuple[float, ...] = warmth,
        size: tuple[float, float] = (326, 228),
        **more: Any,
    ) -> Callable[[], Widget]:
        def build() -> LegPanel:
            panel = LegPanel(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if turned:
                radians = Float64Array([math.radians(angle) for angle in turned])
                panel.show(JointState(name=[f"{place}_leg_joint" for place in PLACES], position=radians))
            if warm:
                panel.show(MotorArray(names=PLACES, temperatures=Float64Array(warm)))
            return panel

        return build

    cool = (34.0, 36.0, 32.0, 33.0, 37.0, 35.0)
    return {
        "never": made((), ()),
        "live": made(state="live"),
        "cool": made(warm=cool, state="live"),
        "without temperatures": made(warm=(), state="live"),
        "not measured": made(
            (22, math.nan, 12, -20, 41, -9), (34.0, math.nan, 30.0, 33.0, 41.0, 35.0), state="live"
        ),
        "small": made(size=(176, 176), state="live"),
        "small never": made((), (), size=(176, 176)),
        "phone": made(size=(190, 132), state="live"),
        "narrow": made(size=(150, 300), state="live"),
        "strip": made(size=(420, 110), state="live"),
        "low": made(size=(120, 54), state="live"),
        "large": made(size=(480, 330), state="live"),
        "stale": made(state="stale", age=2.0),
        "alarm": made(state="alarm"),
        "disabled": made(state="disabled"),
    }
