"""Compass card that turns under a fixed pointer, with the heading in the middle.

compass = Compass()
robot.on("/imu/data", compass.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.graphics import PopMatrix, PushMatrix, Rotate, Translate
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.core.units import heading_from_yaw, yaw_from_heading
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Manoeuvre
from bridge.msgs.sensor_msgs import Imu
from widgets.core.canvas_ink import Drawing, Ink, Word, Words, tint
from widgets.core.geometry import dial_point, dial_text, heading_of, heading_text
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["Compass", "samples"]

BEARINGS = range(0, 360, 30)
"""That the card has in figures [deg]."""
STEP = 5
"""Between two ticks of the card [deg]."""
HOLDS = ("course", "hover")
"""Kinds of manoeuvre that hold a heading."""
UNKNOWN = 0.5
"""Opacity while the heading is not known, 0 to 1."""


class Compass(Drawing):
    """Which way the bow points."""

    accepts: ClassVar = (Imu, Odometry, PoseWithCovarianceStamped, Manoeuvre)
    shown_beside: ClassVar = (Manoeuvre,)
    drawn_from: ClassVar = ("heading", "wanted", "transparent")

    heading = NumericProperty(math.nan)
    """Of the bow [deg], 0 north, clockwise; NaN when not known."""
    wanted = NumericProperty(math.nan)
    """Where it should point [deg]; NaN for no target."""
    transparent = BooleanProperty(False)
    """Let what is behind shine through the card."""

    def _side(self) -> float:
        return min(self.width, self.height)

    side = AliasProperty(_side, bind=["size"], cache=True)
    """Diameter of the whole instrument [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words, self._reading = Ink(), Words(), Words()
        self._place, self._turn = Translate(), Rotate(axis=(0, 0, 1))
        self._card_look: tuple[object, ...] = ()
        self._marks_look: tuple[object, ...] = ()
        self._written: tuple[object, ...] = ()
        for instruction in (PushMatrix(), self._place, self._turn):
            self._ink.add(instruction)
        self._card = self._ink.sheet()
        self._ink.add(PopMatrix())
        self._marks = self._ink.sheet()
        super().__init__(**kwargs)
        for part in (self._ink, self._words.canvas, self._reading.canvas):
            self.canvas.add(part)
        self.bind(side=self._round)
        self._round()

    def _round(self, *_: object) -> None:
        self.veil_radius = self.side / 2

    def show(self, msg: Imu | Odometry | PoseWithCovarianceStamped | Manoeuvre) -> None:
        """Take the heading out of the message, or out of an order the one to hold.

        An Imu that measures no orientation gives NaN, and so does an order that holds none.
        """
        if isinstance(msg, Manoeuvre):
            self.wanted = heading_from_yaw(msg.yaw) if msg.kind in HOLDS else math.nan
        else:
            self.heading = heading_of(msg)

    def draw(self) -> None:
        """Turn the card; draw it anew only when its size or colours have changed."""
        look = (self.side, theme.name, self.transparent, self.state)
        if look != self._card_look:
            self._card_look = look
            self._card.fill(self._card_shapes())
        known = not math.isnan(self.heading)
        strength = 1.0 if known else UNKNOWN
        self._place.xy = self.center
        self._turn.angle = self.heading if known else 0.0
        self._ink.fade(strength)
        self._draw_marks()
        written = (*look, known, theme.font)
        if written == self._written:
            self._words.move(self._figure_places(known))
        else:
            self._written = written
            self._words.write(self._figures(known), strength)
        self._reading.write([self._reading_word(known)], strength)

    def _draw_marks(self) -> None:
        """The pointer, and where the bow should point: most messages leave them as they are."""
        aside = self.wanted - self.heading
        look = (*self.center, self.side, theme.name, None if math.isnan(aside) else aside)
        if look != self._marks_look:
            self._marks_look = look
            self._marks.fill(self._mark_shapes())

    def _card_shapes(self) -> Shapes:
        shapes, radius = Shapes(), self.side / 2 - dp(3)
        shapes.disc(0, 0, radius, tint(theme.surface, 0.82 if self.transparent else 1.0))
        edge = theme.danger if self.state == "alarm" else theme.line
        shapes.ring(0, 0, radius, max(dp(1.6), radius * 0.016), edge)
        for every, length, width, colour in self._ticks():
            bearings = [b for b in range(0, 360, STEP) if (b % 30 == 0) == (every == 30)]
            outer = np.array([dial_point(b, radius * 0.94) for b in bearings])
            inner = np.array([dial_point(b, radius * (0.94 - length)) for b in bearings])
            shapes.segments(outer, inner, max(dp(1), radius * width), colour)
        return shapes

    def _ticks(self) -> Iterator[tuple[int, float, float, Any]]:
        yield STEP, 0.05, 0.014, theme.muted
        yield 30, 0.11, 0.026, theme.text

    def _mark_shapes(self) -> Shapes:
        shapes, radius = Shapes(), self.side / 2 - dp(3)
        if not math.isnan(self.wanted) and not math.isnan(self.heading):
            shapes.polygon(self._pointer(self.wanted - self.heading, radius, 0.95), theme.plan)
        shapes.polygon(self._pointer(0.0, radius, 1.0), theme.accent)
        return shapes

    def _pointer(self, bearing: float, radius: float, size: float) -> list[tuple[float, float]]:
        corners = ((0.0, 1.0 + 0.03 * size), (-5.0 * size, 0.86), (5.0 * size, 0.86))
        points = [dial_point(bearing + turn, radius * reach) for turn, reach in corners]
        return [(self.center_x + x, self.center_y + y) for x, y in points]

    def _texts(self, known: bool) -> Iterator[Word]:
        yield from self._figures(known)
        yield self._reading_word(known)

    def _figures(self, known: bool) -> Iterator[Word]:
        """Of the card; they stay upright while it turns."""
        radius = self.side / 2 - dp(3)
        for bearing, (x, y) in zip(BEARINGS, self._figure_places(known), strict=True):
            main = bearing % 90 == 0
            colour = theme.danger if bearing == 0 else theme.text
            size = radius * (0.215 if main else 0.15)
            yield Word(dial_text(bearing), x, y, size, colour, bold=main)

    def _figure_places(self, known: bool) -> list[tuple[float, float]]:
        radius, heading = (self.side / 2 - dp(3)) * 0.66, self.heading if known else 0.0
        x, y = self.center
        angles = [yaw_from_heading(bearing - heading) for bearing in BEARINGS]
        return [(x + radius * math.cos(angle), y + radius * math.sin(angle)) for angle in angles]

    def _reading_word(self, known: bool) -> Word:
        radius, (x, y) = self.side / 2 - dp(3), self.center
        shift = radius * 0.06 if known else 0.0  # the degree sign hangs over, so that the figures are centred
        return Word(heading_text(self.heading), x + shift, y, radius * 0.345, theme.text, bold=True)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the instrument by name."""

    def made(**kwargs: Any) -> Callable[[], Widget]:
        return lambda: Compass(size_hint=(None, None), size=(dp(220), dp(220)), **kwargs)

    return {
        "never": made(),
        "live": made(heading=98.0, wanted=113.0, state="live"),
        "north": made(heading=359.6, state="live"),
        "stale": made(heading=214.0, wanted=240.0, state="stale", age=4.0),
        "alarm": made(heading=214.0, state="alarm"),
        "disabled": made(heading=98.0, state="disabled"),
    }
