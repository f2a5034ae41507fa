"""Turn rate, bank and pitch of a robot on three scales: how fast it turns, how far it leans, where its bow points up or down.

tape = TurnTape()
robot.on("/imu/data", tape.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
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
from widgets.core.canvas_ink import NO_INDICES, NO_VERTICES, Word, Words, tint
from widgets.core.geometry import steady
from widgets.core.icons import icon
from widgets.core.language import DASH, figure, language, mark, tr
from widgets.core.shapes import FLOATS, Shapes
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
        self._rows: list[_Row] = []
        self._look: tuple[object, ...] = ()
        self._kinds: list[tuple[object, ...]] = []
        super().__init__(**kwargs)
        self._still, self._moving, self._over = (self._ink.sheet() for _ in range(3))
        self._pointers = _Pointers()
        self._figures = [Words() for _ in range(3)]
        for words in self._figures:
            self.canvas.add(words.canvas)
        self.veil_radius = self.card_corner

    @property
    def texts(self) -> list[str]:
        """What is written: the names, then figures and signs."""
        return self._words.texts + [text for row in self._rows for text in row.words.texts]

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

    def draw(self) -> None:
        """Move pointers, and write the figures that are others; all the rest is drawn anew where it is another."""
        look: tuple[object, ...] = (*self.pos, *self.size, self.state, self.card, language.name)
        look += (self.max_turn_rate, self.max_lean, self.warn_lean, theme.name, theme.font, dp(1), sp(1))
        if look != self._look:
            self._look, self._kinds = look, []
            self._lay()
        values = (self.turn_rate, self.bank, self.pitch)
        kinds, places = [], []
        for row, value in zip(self._rows, values, strict=False):
            known = self.state != "never" and math.isfinite(value)
            much = known and abs(value) >= row.warns
            row.write(value if known else math.nan, much=much)
            kind, place = row.pointer(value, much=much) if known else ((), 0.0)
            kinds.append(kind)
            places.append(place)
        if kinds != self._kinds:
            self._kinds = kinds
            self._pointers = _Pointers(self._rows, kinds)
            self._moving.indices = self._pointers.indices
            self._zero()
        self._moving.vertices = self._pointers.moved(places)

    def _lay(self) -> None:
        """The scales one below the other; where there is little height, that of turning alone."""
        inner = self.height - 2 * self.edge
        fitting = max(1, min(3, int(inner / sp(34))))
        high = min(inner / fitting, dp(64))
        left = self.x + self.edge
        right = self.right - self.edge - (dp(20) if self.alarmed else 0)  # an alarm has its sign behind them
        self._rows = []
        for words in self._figures:
            words.write(())
        for name, unit, most, warns in (
            (_TURN, "°/s", self.max_turn_rate, math.inf),
            (_BANK, "°", self.max_lean, self.warn_lean),
            (_PITCH, "°", self.max_lean, self.warn_lean),
        )[:fitting]:
            middle = self.top - self.edge - (len(self._rows) + 0.5) * inner / fitting
            at = (left, right, middle + high * 0.24, middle - high * 0.2)
            self._rows.append(_Row(name, unit, most, warns, at, self._figures[len(self._rows)]))
        shapes = Shapes()
        for row in self._rows:
            _ticks(shapes, row.ends, row.scale_y)
        self._still.fill(shapes)
        self._words.write(row.title for row in self._rows)

    def _zero(self) -> None:
        """The mark in the middle of a turn that is known, above its bar."""
        shapes = Shapes()
        for row, kind in zip(self._rows, self._kinds, strict=True):
            if row.name == _TURN and kind:
                shapes.stamp(_stamp("zero", tuple(theme.text), dp(1)), row.middle, row.scale_y)
        self._over.fill(shapes)


class _Row:
    """A scale with its name and figure."""

    def __init__(
        self,
        name: str,
        unit: str,
        most: float,
        warns: float,
        at: tuple[float, float, float, float],
        words: Words,
    ) -> None:
        """`most` is at its ends, from `warns` on it is much; `at` is left, right, height of the words and of the scale [px]."""
        self.name, self.unit, self.most, self.warns, self.words = name, unit, most, warns, words
        self.left, self.right, self.text_y, self.scale_y = at
        self.ends = self.left + dp(4), self.right - dp(4)
        self.middle, self.half = (self.ends[0] + self.ends[1]) / 2, (self.ends[1] - self.ends[0]) / 2
        title = tr(name).upper()
        self.title = Word(title, self.left, self.text_y, sp(11.5), theme.muted, anchor=(0, 0.5))
        self._room = self.right - self.left - wide(title, sp(11.5)) - dp(8)
        self._written: tuple[object, ...] = ()

    def write(self, value: float, *, much: bool) -> None:
        """The figure of a value, NaN for not known, with a sign where it is much: a lean is no lean by its colour alone."""
        known = math.isfinite(value)
        written = (round(value) if known else None, value > 0, much)
        if written == self._written:
            return
        self._written = written
        role = theme.warn if much else theme.text if known else theme.muted
        shown = first_fitting(self._said(value), sp(15), self._room - (dp(22) if much else 0.0), bold=True)
        words = [Word(shown, self.right, self.text_y, sp(15), role, bold=True, anchor=(1, 0.5))]
        if much:
            at = self.right - wide(shown, sp(15), bold=True) - dp(13)
            words.append(Word(icon("warning_fill"), at, self.text_y, sp(17), role, font=theme.icons))
        self.words.write(words)

    def _said(self, value: float) -> tuple[str, ...]:
        """The figure with its side, without, longest first."""
        if not math.isfinite(value):
            return (DASH,)
        text = f"{figure(abs(value), 0)}{self.unit}"
        plus, minus = _SIDES[self.name]
        side = "" if text.startswith("0") else tr(plus if value > 0 else minus)
        return (f"{text} {side}".strip(), text)

    def pointer(self, value: float, *, much: bool) -> tuple[tuple[object, ...], float]:
        """What points at a value, and where [px].

        Zero is in the middle; a value above 0 is to the left, as the robot turns and leans, and pitch to the right.
        """
        share = value / self.most
        limited = min(max(share, -1.0), 1.0)
        at = self.middle + self.half * (limited if self.name == _PITCH else -limited)
        colour = tuple(theme.warn if much else theme.accent)
        kind = "pointer" if self.name != _TURN else "bar"
        if abs(share) > 1.0:
            kind = "right" if at > self.middle else "left"
        elif kind == "bar" and abs(at - self.middle) <= dp(1):
            at = self.middle
        return (kind, colour), at


class _Pointers:
    """What points at the values of some rows; `moved` moves it in place."""

    def __init__(self, rows: Sequence[_Row] = (), kinds: Sequence[tuple[Any, ...]] = ()) -> None:
        """Of each row what it has: a bar or a mark in its colour, or nothing."""
        shapes, moves = Shapes(), []
        for number, (row, kind) in enumerate(zip(rows, kinds, strict=True)):
            if not kind:
                continue
            name, colour = kind
            if row.name == _TURN:  # a bar from the middle: two of its corners move
                shapes.line(
                    np.array([(row.middle, row.scale_y), (row.middle + 1, row.scale_y)]), dp(7), colour
                )
                moves += [
                    (number, row.middle, 0),
                    (number, row.middle, 0),
                    (number, 0.0, 1),
                    (number, 0.0, 1),
                ]
            if name != "bar":
                mark_ = _stamp(name, colour, dp(1))
                shapes.stamp(mark_, 0.0, row.scale_y)
                moves += [(number, float(x), 1) for x in mark_[0].reshape(-1, FLOATS)[:, 0]]
        vertices, self.indices = shapes.arrays()
        self._vertices = vertices if moves else NO_VERTICES
        self.indices = self.indices if moves else NO_INDICES
        self._made = self._vertices.reshape(-1, FLOATS)
        table = np.array(moves or [(0, 0.0, 0)])
        self._rows, self._rest, self._share = table[:, 0].astype(np.int64), table[:, 1], table[:, 2]

    def moved(self, places: Sequence[float]) -> NDArray[np.float32]:
        """Vertices with each row's mark at its place [px]."""
        at = np.array(places)[self._rows] if places else self._rest
        at *= self._share
        np.add(at, self._rest, out=self._made[:, 0], casting="same_kind")
        return self._vertices


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
