"""Strip of headings that runs past a fixed pointer, for the top of a video picture.

tape = HeadingTape()
robot.on("/imu/data", tape.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, NumericProperty
from kivy.uix.widget import Widget
from numpy.typing import NDArray

from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu
from widgets.core.canvas_ink import Drawing, Ink, Word, Words
from widgets.core.geometry import CARDINALS, DASH, heading_of, shortest_turn, steady, tape_marks
from widgets.core.language import tr
from widgets.core.shapes import FLOATS, Shapes
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
FADE_STEP = 0.125
"""A tick pales in steps of this shift, of less than a shade each [deg]."""


class Strip:
    """Ticks and labels round a label in the middle, and how they pale as they slide from there by up to a label's distance."""

    def __init__(self, tape: HeadingTape, look: tuple[object, ...]) -> None:
        self.look = look
        """What it was made for."""
        self.pace = tape.per_degree
        self.limit = tape.span / 2 - dp(10) / self.pace
        """From the middle to where there is no tick any more [deg]."""
        self.end = (tape.end - tape.width / 2) / self.pace
        """From the middle to where the strip ends [deg]."""
        self.fall = 2.2 / tape.span
        """How much a tick pales to the sides [1/deg]."""
        self.marks: list[int] = []
        """Ticks, from the label in the middle [deg]: first those with a label, then the others."""
        self.labelled: list[int] = []
        self._draw(tape)
        self._made = self.vertices.reshape(-1, 4, FLOATS)
        self._rest = self._made[:, :, 0].copy()
        shifts = -np.arange(0.0, LABELLED, FADE_STEP)[:, None]
        ticks = shifts + np.array(self.marks)
        self._strengths = self._faded(ticks, -self.limit, min(self.limit, self.end)).astype(np.float32)
        labels, margin = shifts + np.array(self.labelled), dp(18) / self.pace
        left, right = max(margin - tape.span / 2, -self.limit), min(self.end - margin, self.limit)
        self._label_strengths = self._faded(labels, left, right).tolist()

    def _draw(self, tape: HeadingTape) -> None:
        marks = tape_marks(LABELLED / 2, 2 * self.limit + LABELLED, STEP) or [0]
        high, shapes = tape.top - tape.height * 0.14, Shapes()
        for every, length, width in ((LABELLED, 0.26, 2.0), (STEP, 0.13, 1.6)):
            own = [mark for mark in marks if (mark % LABELLED == 0) == (every == LABELLED)]
            top = np.array([(tape.center_x + mark * self.pace, high) for mark in own]).reshape(-1, 2)
            shapes.segments(top, top - np.array([0, tape.height * length]), dp(width), theme.text)
            self.marks += own
        self.labelled = [mark for mark in self.marks if mark % LABELLED == 0]
        self.vertices, self.indices = shapes.arrays()

    def _faded(self, places: NDArray[np.float64], left: float, right: float) -> NDArray[np.float64]:
        """Opacity at places [deg from the middle]; none outside of `left` to `right`."""
        return np.asarray(
            np.clip(1.4 - self.fall * np.abs(places), 0.2, 1.0) * ((places > left) & (places < right))
        )

    def slid(self, by: float) -> NDArray[np.float32]:
        """Vertices when the middle is `by` [deg] to the right of the label, less than to the next; they are changed in place."""
        np.add(self._rest, -by * self.pace, out=self._made[:, :, 0])
        self._made[:, :, 11] = self._strengths[_step(by)][:, None]
        return self.vertices

    def labels(self, by: float) -> tuple[list[float], list[float]]:
        """Of each label then, how far it is from the middle [px] and its opacity."""
        pace = self.pace
        return [(mark - by) * pace for mark in self.labelled], self._label_strengths[_step(by)]


def _step(by: float) -> int:
    """Row of the tables for a shift [deg]; rounding may make it that to the next label."""
    return min(int(by / FADE_STEP), round(LABELLED / FADE_STEP) - 1)


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

    @property
    def end(self) -> float:
        """Where ticks and labels end, from the left edge [px]."""
        if self.badge:
            return float(self.badge_pos[0] - self.x - dp(4))
        return float(self.width - (dp(30) if self.alarmed else 0))

    def __init__(self, **kwargs: Any) -> None:
        self._ink, self._words = Ink(), Words()
        self._ticks, self._pointers = self._ink.sheet(), self._ink.sheet()
        self._strip: Strip | None = None
        self._written: tuple[object, ...] = ()
        self._pointed: tuple[object, ...] = ()
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
        """Bring ticks, labels and pointers up to date: the strip slides, and is made anew only where it is another."""
        look: tuple[object, ...] = (*self.pos, *self.size, self.span, self.badge, self.state)
        look += (theme.name, theme.font, dp(1), sp(1))
        if math.isnan(self.heading):
            self._strip = None
            self._ticks.fill(Shapes())
            self._written = ()
            x, y = self.center_x, self.y + self.height * 0.36
            self._words.write([Word(DASH, x, y, sp(18), theme.text, bold=True)])
        else:
            if self._strip is None or look != self._strip.look:
                self._strip = Strip(self, look)
                self._ticks.indices = self._strip.indices
            self._slide(self._strip)
        self._draw_pointers(look)

    def _slide(self, strip: Strip) -> None:
        middle = math.floor(self.heading / LABELLED) * LABELLED
        by = self.heading - middle
        self._ticks.vertices = strip.slid(by)
        if (written := (strip, middle)) != self._written:
            self._written = written
            self._words.write([self._label((middle + mark) % 360) for mark in strip.labelled])
        aside, strengths = strip.labels(by)
        x = self.center_x
        self._words.slide([x + each for each in aside], self.y + self.height * 0.34, strengths)

    def _label(self, heading: int) -> Word:
        role = theme.danger if heading == 0 else theme.text
        text = tr(CARDINALS.get(heading, f"{heading}"))
        return Word(text, self.center_x, self.y, sp(16), role, bold=heading in CARDINALS)

    def _draw_pointers(self, look: tuple[object, ...]) -> None:
        """The own heading's, and that of where it should point."""
        wanted = self.place_of(self.wanted)
        pointed = (*look, None if math.isnan(wanted) else wanted)
        if pointed == self._pointed:
            return
        self._pointed = pointed
        shapes = Shapes()
        if not math.isnan(wanted):
            limit = self.width / 2 - dp(12)
            self._pointer(shapes, self.center_x + min(max(wanted, -limit), limit), theme.plan, dp(7))
        self._pointer(shapes, self.center_x, theme.accent, dp(9))
        self._pointers.fill(shapes)

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
