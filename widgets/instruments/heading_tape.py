"""Strip of headings that runs past a fixed pointer, for the top of a video picture.

tape = HeadingTape()
robot.on("/imu/data", tape.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, NumericProperty
from kivy.uix.widget import Widget

from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu
from widgets.core.canvas_ink import Drawing, Ink, Word, Words, tint
from widgets.core.geometry import CARDINALS, DASH, heading_of, shortest_turn, steady, tape_marks
from widgets.core.shapes import Shapes
from widgets.core.surfaces import Glass
from widgets.core.theme import theme

__all__ = ["HeadingTape", "samples"]

Builder.load_string("""
<HeadingTape>:
    card_corner: theme.corner
""")

STEP, LABELLED = 5, 15
"""Between two ticks and between two labels [deg]."""
SEEN = 0.25
"""A shift that is less is not seen [px]."""


class HeadingTape(Glass, Drawing):
    """Which way the bow points, on a strip."""

    accepts: ClassVar = (Imu, Odometry, PoseWithCovarianceStamped)
    grid_size: ClassVar = (5, 2)
    drawn_from: ClassVar = ("heading", "wanted", "span", "badge")

    heading = NumericProperty(math.nan)
    """Of the bow [deg], 0 north, clockwise; NaN when not known."""
    wanted = NumericProperty(math.nan)
    """Where it should point [deg]; NaN for no target."""
    span = NumericProperty(75.0)
    """How much of the horizon the strip shows [deg]."""

    def _per_degree(self) -> float:
        return self.width / self.span

    per_degree = AliasProperty(_per_degree, bind=["width", "span"], cache=True)
    """Length of one degree [px]."""

    def _badge_pos(self) -> tuple[float, float]:
        width, height = self.badge_size
        return self.right - width - dp(8), self.center_y - height / 2

    badge_pos = AliasProperty(_badge_pos, bind=["badge_size", "pos", "size"], cache=True)
    """The age stands at the end; the strip ends before it."""

    def _end(self) -> float:
        """Where ticks and labels end, from the left edge [px]."""
        if self.badge:
            return float(self.badge_pos[0] - self.x - dp(4))
        return float(self.width - (dp(30) if self.alarmed else 0))

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        super().__init__(**kwargs)
        self.canvas.add(self._ink)
        self.canvas.add(self._words.canvas)

    def show(self, msg: Imu | Odometry | PoseWithCovarianceStamped) -> None:
        """Take the heading out of the message; an Imu that measures no orientation gives NaN."""
        self.heading = steady(self.heading, heading_of(msg), SEEN / max(1.0, self.per_degree))

    def place_of(self, heading: float) -> float:
        """Where `heading` [deg] is on the strip, measured from its middle [px]; NaN while the own is not known."""
        return shortest_turn(self.heading, heading) * self.per_degree

    def draw(self) -> None:
        """Bring ticks, labels and pointers up to date."""
        shapes = Shapes()
        if math.isnan(self.heading):
            words = [Word(DASH, self.center_x, self.y + self.height * 0.36, sp(18), theme.text, bold=True)]
        else:
            words = [*self._strip(shapes)]
            self._wanted_mark(shapes)
        self._pointer(shapes, self.center_x, theme.accent, dp(9))
        self._ink.fill(shapes)
        self._words.write(words)

    def _strip(self, shapes: Shapes) -> Iterator[Word]:
        edge = dp(10) / self.per_degree
        marks = tape_marks(self.heading, self.span - 2 * edge, STEP)
        places = self.center_x + np.array([(mark - self.heading) * self.per_degree for mark in marks])
        shown = np.clip(1.4 - 1.1 * np.abs(places - self.center_x) / (self.width / 2), 0.2, 1.0)
        high = self.top - self.height * 0.14
        for every, length, width in ((LABELLED, 0.26, 2.0), (STEP, 0.13, 1.6)):
            own = np.array([(mark % LABELLED == 0) == (every == LABELLED) for mark in marks])
            own &= places - self.x < self._end()
            top = np.stack([places[own], np.full(own.sum(), high)], axis=1)
            colours = np.tile(np.asarray(theme.text, np.float32), (len(top), 1))
            colours[:, 3] = shown[own]
            shapes.segments(top, top - np.array([0, self.height * length]), dp(width), colours)
        for mark, place, strength in zip(marks, places, shown, strict=True):
            if mark % LABELLED == 0 and dp(18) < place - self.x < self._end() - dp(18):
                yield self._label(mark % 360, float(place), float(strength))

    def _label(self, heading: int, place: float, strength: float) -> Word:
        main = heading in CARDINALS
        role = theme.danger if heading == 0 else theme.text
        text, y = CARDINALS.get(heading, f"{heading}"), self.y + self.height * 0.34
        return Word(text, place, y, sp(16), tint(role, strength), bold=main)

    def _wanted_mark(self, shapes: Shapes) -> None:
        if not math.isnan(self.wanted):
            limit = self.width / 2 - dp(12)
            place = min(max(self.place_of(self.wanted), -limit), limit)
            self._pointer(shapes, self.center_x + place, theme.plan, dp(7))

    def _pointer(self, shapes: Shapes, x: float, colour: Any, half: float) -> None:
        top = self.top + dp(1)
        shapes.polygon([(x, top), (x - half, top - half * 1.35), (x + half, top - half * 1.35)], colour)


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the strip by name."""

    def made(**more: Any) -> Callable[[], Widget]:
        return lambda: HeadingTape(size_hint=(None, None), size=(dp(420), dp(52)), **more)

    return {
        "never": made(),
        "live": made(heading=95.0, wanted=112.0, state="live"),
        "north": made(heading=358.0, wanted=200.0, state="live"),
        "stale": made(heading=95.0, state="stale", age=5.0),
        "alarm": made(heading=95.0, state="alarm"),
        "disabled": made(heading=95.0, state="disabled"),
    }
