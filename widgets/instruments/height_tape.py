"""Height above the ground, climb rate, and whether the vehicle is in the air at all.

height = HeightTape()
robot.on("/flight", height.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import ControlStatus, FlightState
from widgets.core.base import fitting_size
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import DASH, nice_floor
from widgets.core.language import brief_figure, mark, tr
from widgets.core.quantities import from_shown, said, to_shown, unit_of
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.parts.sensor_card import Gauge, first_fitting, wide

__all__ = ["HeightTape", "samples"]

PHASES = {"landed": "muted", "taking_off": "accent", "flying": "accent", "landing": "warn"}
"""Phase of a flight to the role of the colour of its word."""
SPANS = ((8.0, 4.0), (40.0, 12.0), (math.inf, 40.0))
"""Up to which height how much of it the tape shows [m]."""
TIGHT = 130
"""Lower than this the phase stands where else its name is [dp]."""
STEADY = 0.05
"""Climbing or sinking slower than this is neither [m/s]."""
PHASE_WORDS = {
    "landed": mark("Landed"),
    "taking_off": mark("Taking off"),
    "flying": mark("Flying"),
    "landing": mark("Landing"),
    "turned_over": mark("Turned over"),
}
"""Phases of a flight to what they are called."""
SHORT = {"taking_off": mark("Rising")}
"""A phase in a shorter word, where there is no room for its own."""
HOVERS = mark("Hovers")
"""What is stopped in the air does this."""


class HeightTape(Gauge):
    """A scale that runs past a fixed pointer, the ground as the end of it; a bar beside it for the climb."""

    accepts: ClassVar = (FlightState, ControlStatus)
    shown_beside: ClassVar = (ControlStatus,)
    grid_size: ClassVar = (2, 5)
    drawn_from: ClassVar = ("own_height", "climb", "phase", "stopped", "wanted", "max_climb")

    own_height = NumericProperty(math.nan)
    """Above the ground [m]; NaN when not known, or higher than is measured. `height` is the widget's own."""
    climb = NumericProperty(math.nan)
    """Upward speed [m/s]; NaN when not known."""
    phase = StringProperty("")
    """`landed`, `taking_off`, `flying` or `landing`; empty before the first."""
    stopped = BooleanProperty(False)
    """STOP is pressed: what is in the air hovers."""
    wanted = NumericProperty(math.nan)
    """Height to go to or to hold [m]; NaN for no target."""
    max_climb = NumericProperty(1.0)
    """Upward speed of a full bar [m/s], above 0."""

    def _figure_text(self) -> str:
        if not math.isfinite(self.own_height):
            return DASH
        return said(self.own_height, "height", 1 if self.own_height < 99.95 else 0).text

    words = AliasProperty(_figure_text, bind=["own_height"], cache=True)
    """The height as written, in the operator's unit."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"title": tr("Height"), **kwargs})

    def show(self, msg: FlightState | ControlStatus) -> None:
        """Show height, climb and phase, NaN is a dash; or take over whether STOP is pressed."""
        if isinstance(msg, ControlStatus):
            self.stopped = msg.stopped
            return
        self.phase = msg.phase
        self.own_height = round(msg.height, 2) if math.isfinite(msg.height) else math.nan
        self.climb = round(msg.climb, 2) if math.isfinite(msg.climb) else math.nan

    @property
    def phase_words(self) -> str:
        """The phase in words; `Hovers` for what is stopped in the air."""
        return (
            tr(HOVERS)
            if self.hovers
            else tr(PHASE_WORDS.get(self.phase, self.phase.replace("_", " ").capitalize()))
        )

    @property
    def hovers(self) -> bool:
        """It is in the air, and STOP is pressed."""
        return self.stopped and self.phase not in ("", "landed", "turned_over")

    def _span(self) -> float:
        known = 0.0 if math.isnan(self.own_height) else self.own_height
        return next(span for limit, span in SPANS if known < limit)

    def marks(self, shapes: Shapes) -> Iterator[Word]:
        """Figures at the left, the tape at the right; where it is low the height in a line."""
        if self.low:
            yield from self._brief(shapes)
            return
        room = self.width - 2 * self.edge
        scale = max(room * 0.36, dp(60 if room >= dp(110) else 54))
        bottom, top = self.y + self.edge, self.top - self.edge
        left = self.x + self.edge
        brief = bool(self.phase) and self.height < dp(TIGHT)
        name = "" if brief else self.title.upper()
        yield Word(name, left, top - sp(6), sp(11.5), theme.muted, anchor=(0, 0.5))
        scale_top = top - dp(18) if self.alarmed else top
        yield from self._tape(shapes, (self.right - self.edge - scale, bottom, scale, scale_top - bottom))
        yield from self._figures(
            shapes, (left, bottom, room - scale - dp(8), top - sp(0 if brief else 16) - bottom)
        )

    def _figures(self, shapes: Shapes, box: tuple[float, float, float, float]) -> Iterator[Word]:
        left, bottom, room, high = box
        y = bottom + high - sp(10)
        role = "warn" if self.hovers else PHASES.get(self.phase, "muted")
        short = self.phase_words if self.hovers else tr(SHORT.get(self.phase, self.phase_words))
        said = first_fitting((self.phase_words,), sp(13), room, bold=True) or short
        size = fitting_size([said], sp(13), room, bold=True)
        yield Word(said, left, y, size, theme.roles[role], bold=True, anchor=(0, 0.5))
        size = min(sp(44), high * 0.34)
        size = min(size, size * room / (wide(self.words, size, bold=True) + size * 0.85))
        middle = bottom + high * 0.49
        yield Word(self.words, left, middle, size, theme.text, bold=True, anchor=(0, 0.5))
        if self.words != DASH:
            behind = left + wide(self.words, size, bold=True) + size * 0.14
            unit, small = unit_of("height"), max(size * 0.5, sp(11))
            yield Word(unit, behind, middle - size * 0.16, small, theme.muted, anchor=(0, 0.5))
        elif self.phase:
            yield Word(
                first_fitting((tr("out of reach"),), sp(12), room),
                left,
                middle - sp(18),
                sp(12),
                theme.muted,
                anchor=(0, 0.5),
            )
        yield from self._climb_words(shapes, left, bottom + high * (0.14 if room >= dp(60) else 0.2), room)

    def _climb_words(self, shapes: Shapes, left: float, y: float, room: float) -> Iterator[Word]:
        """How fast it climbs or sinks, behind an arrow."""
        up = self.climb > STEADY
        if up or self.climb < -STEADY:
            sign = 1 if up else -1
            x, half = left + dp(6), dp(6)
            shapes.polygon(
                [(x, y + sign * half), (x - half, y - sign * half), (x + half, y - sign * half)], theme.accent
            )
            told, shift = said(abs(self.climb), "speed", 1).text, dp(16)
        else:
            nothing = said(0.0, "speed", 1).text
            told, shift = (nothing, 0.0) if math.isfinite(self.climb) else (DASH, 0.0)
        size = sp(18 if room >= dp(84) else 15)
        yield Word(told, left + shift, y, size, theme.text, bold=True, anchor=(0, 0.5))
        if told != DASH:
            behind, small = (
                left + shift + wide(told, size, bold=True) + dp(3),
                sp(12 if room >= dp(84) else 11),
            )
            unit = unit_of("speed")
            if wide(unit, small) > left + room + dp(4) - behind:  # below, where there is no room behind
                behind, y = left + shift, y - size * 0.5 - sp(5)
            yield Word(unit, behind, y - dp(1), small, theme.muted, anchor=(0, 0.5))

    def _tape(self, shapes: Shapes, box: tuple[float, float, float, float]) -> Iterator[Word]:
        left, bottom, room, high = box
        bar = dp(8)
        right, middle = left + room - bar - dp(6), bottom + high / 2
        shapes.segments(
            np.array([[(left + right) / 2, bottom]]),
            np.array([[(left + right) / 2, bottom + high]]),
            right - left,
            theme.raised,
        )
        self._climb_bar(shapes, right + dp(6) + bar / 2, (bottom, high), bar)
        if not math.isfinite(self.own_height):
            yield Word(DASH, (left + right) / 2, middle, sp(16), theme.muted, bold=True)
            return
        scale = high / self._span()
        self._ground(shapes, (left, right, bottom), middle - self.own_height * scale)
        rung = nice_floor(to_shown(sp(44) / scale, "height"))
        step = from_shown(rung, "height")
        first = math.ceil((self.own_height - self._span() / 2) / (step / 2))
        last = math.floor((self.own_height + self._span() / 2) / (step / 2))
        for number in range(max(first, 0), last + 1):
            y = middle + (number * step / 2 - self.own_height) * scale
            whole = number % 2 == 0
            reach = dp(10 if whole else 5)
            shapes.segments(np.array([[left, y]]), np.array([[left + reach, y]]), dp(1.5), theme.muted)
            inside = bottom + sp(8) < y < bottom + high - sp(8)
            if whole and number and inside and abs(y - middle) > sp(15):
                yield Word(
                    brief_figure(number * rung / 2), left + dp(15), y, sp(12), theme.muted, anchor=(0, 0.5)
                )
        self._target(shapes, (left, right), (bottom, high), scale)
        word = Word(self.words, left + dp(15), middle, sp(13), theme.text, bold=True, anchor=(0, 0.5))
        ground(shapes, word, theme.surface)
        tip = left + dp(2)
        shapes.polygon(
            [(tip + dp(10), middle), (tip - dp(6), middle + dp(9)), (tip - dp(6), middle - dp(9))],
            theme.accent,
        )
        yield word

    def _ground(self, shapes: Shapes, box: tuple[float, float, float], y: float) -> None:
        """What is under it, where that is on the tape."""
        left, right, bottom = box
        if y > bottom:
            x = (left + right) / 2
            shapes.segments(np.array([[x, bottom]]), np.array([[x, y]]), right - left, theme.ground)
            shapes.segments(np.array([[left, y]]), np.array([[right, y]]), dp(2.4), theme.muted)

    def _target(
        self, shapes: Shapes, span: tuple[float, float], box: tuple[float, float], scale: float
    ) -> None:
        """A pointer at the wanted height, at the end of the tape where it is beyond."""
        if math.isnan(self.wanted):
            return
        (_, right), (bottom, high) = span, box
        limit = high / 2 - dp(7)
        away = min(max((self.wanted - self.own_height) * scale, -limit), limit)
        y = bottom + high / 2 + away
        shapes.polygon([(right - dp(12), y), (right, y + dp(7)), (right, y - dp(7))], theme.plan)

    def _climb_bar(self, shapes: Shapes, x: float, box: tuple[float, float], thick: float) -> None:
        bottom, high = box
        middle = bottom + high / 2
        shapes.segments(
            np.array([[x, bottom]]), np.array([[x, bottom + high]]), thick, tint(theme.muted, 0.25)
        )
        if math.isfinite(self.climb) and abs(self.climb) > STEADY:
            end = middle + high / 2 * min(max(self.climb / self.max_climb, -1.0), 1.0)
            shapes.segments(np.array([[x, middle]]), np.array([[x, end]]), thick, theme.accent)
        shapes.segments(
            np.array([[x - dp(6), middle]]), np.array([[x + dp(6), middle]]), dp(1.5), theme.muted
        )

    def _brief(self, shapes: Shapes) -> Iterator[Word]:
        """As in `1.2 m high`, that it hovers there, or that it has landed."""
        room, size = self.width - 2 * self.edge, min(sp(24), self.height * 0.5)
        if self.phase == "landed":
            yield Word(
                first_fitting((tr("Landed"),), sp(15), room, bold=True),
                *self.center,
                sp(15),
                theme.text,
                bold=True,
            )
            return
        unit = unit_of("height")
        tail = (
            f" {tr('high')}"
            if self.words == DASH
            else tr(" {unit}, hovers").format(unit=unit)
            if self.hovers
            else f" {unit} {tr('high')}"
        )
        behind = max(size * 0.56, sp(12))
        if self.hovers:
            behind = min(behind, fitting_size([tail], behind, room - wide(self.words, size, bold=True)))
        if wide(self.words, size, bold=True) + wide(tail, behind) > room:
            tail = f" {unit}" if self.words != DASH else ""
        taken = wide(self.words, size, bold=True)
        left = self.center_x - (taken + wide(tail, behind)) / 2
        yield Word(self.words, left, self.center_y, size, theme.text, bold=True, anchor=(0, 0.5))
        yield Word(tail, left + taken, self.center_y - size * 0.1, behind, theme.text, anchor=(0, 0.5))


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the tape by name."""

    def made(
        phase: str = "flying",
        height: float = 1.24,
        climb: float = 0.32,
        size: tuple[float, float] = (176, 176),
        **more: Any,
    ) -> Callable[[], Widget]:
        def build() -> HeightTape:
            tape = HeightTape(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if phase:
                tape.show(FlightState(phase=phase, height=height, climb=climb))
            return tape

        return build

    return {
        "never": made(""),
        "live": made(wanted=1.5, state="live"),
        "landed": made("landed", 0.05, 0.0, state="live"),
        "taking off": made("taking_off", 0.4, 0.6, wanted=1.5, state="live"),
        "landing": made("landing", 0.8, -0.5, wanted=0.0, state="live"),
        "stopped": made(climb=0.0, stopped=True, state="live"),
        "stopped upright": made(climb=0.0, stopped=True, size=(124, 150), state="live"),
        "high": made(height=23.6, climb=-0.9, wanted=12.0, state="live"),
        "very high": made(height=112.0, climb=0.0, state="live"),
        "out of reach": made(height=math.nan, climb=0.1, state="live"),
        "large": made(wanted=1.5, size=(326, 228), state="live"),
        "large never": made("", size=(326, 228)),
        "tall": made(wanted=1.5, size=(160, 330), state="live"),
        "upright": made(climb=-0.32, wanted=1.5, size=(124, 150), state="live"),
        "phone": made(wanted=1.5, size=(188, 97), state="live"),
        "low": made(size=(128, 44), state="live"),
        "low landed": made("landed", 0.05, 0.0, size=(128, 44), state="live"),
        "narrow": made(size=(72, 54), state="live", card=False),
        "stale": made(wanted=1.5, state="stale", age=2.0),
        "alarm": made(state="alarm"),
        "disabled": made(state="disabled"),
    }
