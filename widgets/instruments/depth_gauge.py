"""Depth of a vehicle between the surface and the end of a scale, and the depth that is commanded.

depth = DepthGauge()
robot.on("/depth", depth.show)
robot.on("/manoeuvre", depth.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import ControlStatus, Manoeuvre
from bridge.msgs.sensor_msgs import FluidPressure
from widgets.core.canvas_ink import Word, tint
from widgets.core.geometry import DASH, Points, nice_floor
from widgets.core.language import brief_figure, tr
from widgets.core.quantities import said, to_shown, unit_of
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["DepthGauge", "samples"]

GRAVITY = 9.80665
"""[m/s2]"""
REACHES = (2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
"""Depths that the scale may end at [m]."""
HOLDS = ("course", "hover")
"""Kinds of manoeuvre with a depth to hold."""
BELOW = 0.3
"""Deeper than this what is stopped has a way up [m]."""


class DepthGauge(Gauge):
    """A figure and a scale with the surface at its top; the robot is the blue pointer, the wanted depth the violet one."""

    accepts: ClassVar = (FluidPressure, Manoeuvre, ControlStatus)
    shown_beside: ClassVar = (Manoeuvre, ControlStatus)
    grid_size: ClassVar = (2, 5)
    drawn_from: ClassVar = ("depth", "wanted", "held", "stopped", "reach")

    depth = NumericProperty(math.nan)
    """Below the surface [m]; NaN when not known."""
    wanted = NumericProperty(math.nan)
    """Depth to hold [m]; NaN for no target."""
    held = BooleanProperty(False)
    """The robot holds its present depth, and has not reported which one that is."""
    stopped = BooleanProperty(False)
    """STOP is pressed: nothing keeps it below."""
    surface_pressure = NumericProperty(101_325.0)
    """Of the air on the water [Pa]."""
    density = NumericProperty(1000.0)
    """Of the water [kg/m3]."""
    reach = NumericProperty(REACHES[1])
    """Depth at the lower end of the scale [m]; it grows at once and shrinks late."""

    def _figure_text(self) -> str:
        if math.isnan(self.depth):
            return DASH
        return said(self.depth, "height", 1 if self.depth < 99.95 else 0).text

    words = AliasProperty(_figure_text, bind=["depth"], cache=True)
    """The depth as written, in the operator's unit."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Depth"), **kwargs})
        for name in ("depth", "wanted"):
            self.fbind(name, self._fit)
        self._fit()

    @property
    def rises(self) -> bool:
        """It is stopped below the surface, where it weighs less than the water."""
        return self.stopped and self.depth > BELOW

    def show(self, msg: FluidPressure | Manoeuvre | ControlStatus) -> None:
        """Take the depth from a pressure of water and air, the depth to hold from what the robot follows now, or whether it is stopped."""
        if isinstance(msg, ControlStatus):
            self.stopped = msg.stopped
            return
        if isinstance(msg, FluidPressure):
            depth = (msg.fluid_pressure - self.surface_pressure) / (self.density * GRAVITY)
            self.depth = round(max(depth, 0.0), 2) if math.isfinite(depth) else math.nan
            return
        told = msg.kind in HOLDS and math.isfinite(msg.height)
        self.held = msg.kind in HOLDS and not told
        self.wanted = max(-msg.height, 0.0) if told else 0.0 if msg.kind == "surface" else math.nan

    def _fit(self, *_: object) -> None:
        deepest = max((value for value in (self.depth, self.wanted) if math.isfinite(value)), default=0.0)
        fitting = next((reach for reach in REACHES[1:] if reach >= 1.1 * deepest), REACHES[-1])
        if fitting > self.reach or deepest < 0.3 * self.reach:
            self.reach = fitting

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Figures at the left, the scale at the right; where it is low the depth in a line."""
        if self.low:
            yield from self._brief()
            return
        yield from self.header(())
        left, bottom, top = self.x + self.edge, self.y + self.edge, self.top - self.edge
        room = self.width - 2 * self.edge
        scale = max(room * 0.42, dp(58))
        free = top - bottom - (dp(18) if self.alarmed else 0)
        yield from self._scale(shapes, (self.right - self.edge - scale, bottom, scale, free))
        yield from self._figures((left, bottom, room - scale - dp(8), top - sp(16) - bottom))

    def _figures(self, box: tuple[float, float, float, float]) -> Iterator[Word]:
        """The depth large, the wanted one under it."""
        left, bottom, room, high = box
        size = self._fitting(self.words, f" {unit_of('height')}", room, min(sp(44), high * 0.3))
        middle = bottom + high * 0.62
        yield from self._value(self.words, left, middle, size, "text")
        y = middle - size * 0.62 - sp(16)
        if self.rises:
            told = first_fitting((tr("stopped, floats up"), tr("floats up")), sp(13), room, bold=True) or tr(
                "rises"
            )
            yield Word(told, left, y, sp(13), theme.warn, bold=True, anchor=(0, 0.5))
        elif math.isfinite(self.wanted):
            yield Word(tr("Target").upper(), left, y, sp(11.5), theme.plan, anchor=(0, 0.5))
            told = said(self.wanted, "height", 1).text
            small = self._fitting(told, f" {unit_of('height')}", room, min(size * 0.7, sp(26)))
            yield from self._value(told, left, y - sp(8) - small * 0.6, small, "plan")
        else:
            texts = (
                (tr("held where it is"), tr("held"))
                if self.held
                else (tr("no target depth"), tr("no target"))
            )
            role = "plan" if self.held else "muted"
            yield Word(
                first_fitting(texts, sp(12), room), left, y, sp(12), theme.roles[role], anchor=(0, 0.5)
            )

    def _fitting(self, text: str, unit: str, room: float, size: float) -> float:
        """Type in which a figure and its smaller unit fit [px]."""
        taken = wide(text, size, bold=True) + wide(unit, size * 0.5)
        return size if taken <= room else max(size * room / taken, sp(12))

    def _value(self, text: str, left: float, y: float, size: float, role: str) -> Iterator[Word]:
        yield Word(text, left, y, size, theme.roles[role], bold=True, anchor=(0, 0.5))
        if text != DASH:
            behind = left + wide(text, size, bold=True) + size * 0.14
            unit, small = unit_of("height"), max(size * 0.5, sp(11))
            yield Word(unit, behind, y - size * 0.16, small, theme.muted, anchor=(0, 0.5))

    def _scale(self, shapes: Shapes, box: tuple[float, float, float, float]) -> Iterator[Word]:
        """Water below the surface, with marks at round depths, and the two pointers."""
        left, bottom, room, high = box
        top = bottom + high - dp(10)
        right = left + room
        labels = sp(22 if to_shown(self.reach, "height") < 100 else 30)
        bar_left, bar_right = left + dp(14), right - labels - dp(2)
        span = top - bottom - dp(6)
        water = np.array([[(bar_left + bar_right) / 2, bottom], [(bar_left + bar_right) / 2, top]])
        shapes.line(water, bar_right - bar_left, tint(theme.sky, 0.32))
        shapes.line(_waves(bar_left - dp(4), bar_right + dp(4), top), dp(2.2), theme.muted)
        reach = to_shown(self.reach, "height")
        step = nice_floor(reach / (2.5 if span < dp(130) else 4.5))
        for number in range(int(reach / step + 1e-6) + 1):
            deep = number * step
            y = top - deep / reach * span
            start, end = np.array([[bar_right - dp(9), y]]), np.array([[bar_right, y]])
            shapes.segments(start, end, dp(1.5), theme.muted)
            yield Word(brief_figure(deep), right, y, sp(11.5), theme.muted, anchor=(1, 0.5))
        if math.isfinite(self.wanted):
            y = top - min(self.wanted, self.reach) / self.reach * span
            ends = np.array([[bar_left, y], [bar_right, y]])
            shapes.dashes(ends, dp(2.4), theme.plan, period=dp(9), dash=dp(4))
            shapes.polygon(
                [(bar_right - dp(1), y), (bar_right - dp(11), y + dp(6)), (bar_right - dp(11), y - dp(6))],
                theme.plan,
            )
        if math.isfinite(self.depth):
            y = top - min(self.depth, self.reach) / self.reach * span
            ends = np.array([[bar_left - dp(2), y], [bar_right - dp(12), y]])
            shapes.line(ends, dp(3), theme.accent)
            tip = bar_left + dp(4)
            shapes.polygon([(tip, y), (tip - dp(16), y + dp(9)), (tip - dp(16), y - dp(9))], theme.accent)

    def _brief(self) -> Iterator[Word]:
        """As in `4.2 m depth`, or `4.2 m, holds 4.5` where one is to be held."""
        y, room = self.center_y, self.width - 2 * self.edge
        size = min(sp(26), self.height * 0.55)
        behind = max(size * 0.56, sp(12))

        def fits(tail: str) -> bool:
            return wide(self.words, size, bold=True) + wide(tail, behind) <= room

        tails = self._tails()
        tail = next((one for one in tails if fits(one)), tails[-1])
        size = min(size, size * room / (wide(self.words, size, bold=True) + wide(tail, behind)))
        long = wide(self.words, size, bold=True) + wide(tail, behind)
        left = self.center_x - long / 2
        yield Word(self.words, left, y, size, theme.text, bold=True, anchor=(0, 0.5))
        yield Word(
            tail,
            left + wide(self.words, size, bold=True),
            y - size * 0.1,
            behind,
            theme.text,
            anchor=(0, 0.5),
        )

    def _tails(self) -> tuple[str, ...]:
        """Words behind the depth in one line, the longest first."""
        unit = unit_of("height")
        if self.words == DASH:
            return (f" {tr('depth')}", "")
        if self.rises:
            return (tr(" {unit}, floats up").format(unit=unit), f" {unit}, {tr('rises')}", f" {unit}")
        if math.isfinite(self.wanted) and self.wanted > 0:
            told = said(self.wanted, "height", 1).text
            return (
                tr(" {unit}, holds {depth}").format(unit=unit, depth=told),
                f" {unit} → {told}",
                f" → {told}",
            )
        if self.held:
            return (f" {unit}, {tr('held')}", f" {tr('held')}")
        return (f" {unit} {tr('depth')}", f" {unit}")


def _waves(left: float, right: float, y: float) -> Points:
    """A line of small waves from `left` to `right` [px]."""
    x = np.linspace(left, right, 33)
    return np.stack([x, y + np.sin((x - left) / dp(22) * math.tau) * dp(2)], axis=1)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the gauge by name."""

    def made(
        depth: float = 4.2, wanted: float = 4.5, size: tuple[float, float] = (176, 176), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> DepthGauge:
            gauge = DepthGauge(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if math.isfinite(depth):
                gauge.show(FluidPressure(fluid_pressure=101_325.0 + 1000.0 * GRAVITY * depth))
            gauge.wanted = wanted
            return gauge

        return build

    nan = math.nan
    return {
        "never": made(nan, nan),
        "live": made(state="live"),
        "no target": made(wanted=nan, state="live"),
        "held": made(wanted=nan, held=True, state="live"),
        "stopped": made(1.2, nan, stopped=True, state="live"),
        "stopped low": made(1.2, nan, size=(128, 40), stopped=True, state="live"),
        "surface": made(0.0, 0.0, state="live"),
        "deep": made(63.4, 80.0, state="live"),
        "very deep": made(412.0, nan, state="live"),
        "large": made(size=(326, 228), state="live"),
        "large never": made(nan, nan, size=(326, 228)),
        "tall": made(size=(160, 330), state="live"),
        "low": made(size=(128, 40), state="live"),
        "low no target": made(wanted=nan, size=(128, 40), state="live"),
        "low held": made(wanted=nan, held=True, size=(128, 40), state="live"),
        "low never": made(nan, nan, size=(128, 40)),
        "narrow": made(size=(72, 54), state="live", card=False),
        "stale": made(state="stale", age=2.0),
        "alarm": made(state="alarm"),
        "disabled": made(state="disabled"),
    }
