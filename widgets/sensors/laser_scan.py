"""Laser sweep seen from above: free space, near obstacles, and the least distance.

laser = LaserScanView(title="Front laser")
robot.on("/scan", laser.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.widget import Widget
from numpy.typing import NDArray

from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import LaserScan
from widgets.core.canvas_ink import Drawing, Ink, Word, Words, ground, tint
from widgets.core.geometry import DASH, length_text, not_exceeded_by, scan_reach
from widgets.core.icons import icon
from widgets.core.language import language, mark, tr
from widgets.core.quantities import quantities, said
from widgets.core.shapes import Shapes
from widgets.core.surfaces import Glass
from widgets.core.theme import theme
from widgets.map.map_marks import arrow
from widgets.sensors.sweep_ink import AHEAD, Look, SweepInk

__all__ = ["LaserScanView", "samples"]

RINGS = 3
LOW = 2.0
"""A card this many times broader than high keeps its name beside the rings."""


@dataclass(frozen=True)
class Sweep:
    """What a message tells, read once."""

    measured: NDArray[np.float32]
    """Ranges [m]: NaN for what is not believable, the least range for what is too close."""
    angles: NDArray[np.float64]
    """Directions of the beams [rad], from straight ahead, to the left above 0."""
    seen: NDArray[np.float32]
    """The finite ones of the ranges [m]."""


NO_SWEEP = Sweep(np.zeros(0, np.float32), np.zeros(0), np.zeros(0, np.float32))


class LaserScanView(Glass, Drawing):
    """The newest sweep, the robot's bow up. A return is a dot in the colour of its distance."""

    accepts: ClassVar = (LaserScan,)
    grid_size: ClassVar = (4, 4)
    drawn_from: ClassVar = ("scan", "title", "rate", "reach", "near", "close", "card")

    scan: ObjectProperty[LaserScan | None] = ObjectProperty(None, allownone=True, force_dispatch=True)
    """The newest LaserScan; None before the first."""
    title = StringProperty(mark("Laser"))
    """Name of the sensor."""
    rate = NumericProperty(math.nan)
    """Sweeps a second [Hz]; NaN when not known."""
    reach = NumericProperty(0.0)
    """Distance at the edge of the picture [m]; 0 follows what is seen."""
    near = NumericProperty(1.2)
    """Closer than this is a warning [m]."""
    close = NumericProperty(0.6)
    """Closer than this is a danger [m]."""

    def _nearest(self) -> float:
        if self.scan is None:
            return math.nan
        seen = self._sweep(self.scan).seen
        return float(seen.min()) if len(seen) else math.inf

    nearest = AliasProperty(_nearest, bind=["scan"], cache=True)
    """Distance of the nearest return [m]; inf when there is none, NaN before the first sweep."""

    def __init__(self, **kwargs: Any) -> None:
        self.inks = Ink(), Ink()
        """Rings; the robot and the grounds of the words."""
        self.sweep = SweepInk()
        self._words, self._head = Words(), Words()
        self._reach = 0.0
        self._look: tuple[object, Look] | None = None
        self._placed: tuple[tuple[object, ...], tuple[float, float, float]] | None = None
        self._place_drawn: tuple[object, ...] = ()
        self._told: tuple[object, ...] = ()
        self._robot = Shapes().arrays()
        self._read: tuple[LaserScan, Sweep] | None = None
        self._beams: tuple[tuple[float, float, int], NDArray[np.float64]] | None = None
        super().__init__(**kwargs)
        below, above = self.inks
        for part in (below, self.sweep, above, self._words.canvas, self._head.canvas):
            self.canvas.add(part)

    def show(self, msg: LaserScan) -> None:
        """Show a sweep in place of the one before."""
        self.scan = msg

    def draw(self) -> None:
        """Bring free space and dots up to date, and rings and words where they are others."""
        sweep = self._sweep(self.scan) if self.scan else NO_SWEEP
        self._reach = self.reach or scan_reach(
            _farthest(sweep.seen, self.scan.range_max if self.scan else 6.0), self._reach
        )
        half = _half(sweep.angles) if self.scan else AHEAD
        x, y, scale = self._place(half)
        self.sweep.put(sweep.measured, sweep.angles, (x, y), scale, self._reach, self._dots_look())
        self._draw_still((x, y), scale, half)

    def _dots_look(self) -> Look:
        key = (dp(2.3), theme.name, self.close, self.near)
        if self._look is None or self._look[0] != key:
            levels = tuple(theme.danger), tuple(theme.warn), tuple(theme.accent)
            self._look = key, Look(dp(2.3), tint(theme.accent, 0.17), levels, (self.close, self.near))
        return self._look[1]

    def _draw_still(self, at: tuple[float, float], scale: float, half: float) -> None:
        """Rings, words and the robot: most sweeps leave them as they are."""
        place = (at, scale, half, self._reach, *self.size, *self.pos, theme.name, theme.font)
        shown = (*place, quantities.system, language.name)
        if shown != self._place_drawn:
            self._place_drawn, self._told = shown, ()
            below, above = Shapes(), Shapes()
            self._rings(below, at, scale, half)
            self.inks[0].fill(below)
            words = [*self._ring_words(at, scale, half)]
            for word in words:
                ground(above, word, tint(theme.surface, 0.85))
            above.polygon(arrow(*at, AHEAD, dp(15)), theme.text)
            self._robot = above.arrays()
            self._words.write(words)
        self._draw_header()

    def _draw_header(self) -> None:
        """Name, rate and what is near, as far as others than before."""
        nearest = self.nearest
        near = nearest < self.near
        told = (
            *(self.state, self.title, None if math.isnan(self.rate) else round(self.rate)),
            *(math.isnan(nearest), near and round(nearest, 1 if quantities.system == "metric" else 2)),
            nearest < self.close,
        )
        if told == self._told:
            return
        self._told = told
        above, words = Shapes(), [*self._header()]
        above.stamp(self._robot, 0.0, 0.0)
        for word in words:
            ground(above, word, tint(theme.surface, 0.85))
        self.inks[1].fill(above)
        self._head.write(words)

    def _sweep(self, scan: LaserScan) -> Sweep:
        """What the message tells; read once."""
        if self._read is None or self._read[0] is not scan:
            measured = np.array(scan.ranges, dtype=np.float32)
            usual = measured >= scan.range_min
            if not usual.all():
                too_close = measured == -math.inf
                measured[~usual] = math.nan
                measured[too_close] = scan.range_min
            finite = np.isfinite(measured)
            seen = measured if finite.all() else measured[finite]
            self._read = scan, Sweep(measured, self._angles(scan, len(measured)), seen)
        return self._read[1]

    def _angles(self, scan: LaserScan, count: int) -> NDArray[np.float64]:
        key = scan.angle_min, scan.angle_increment, count
        if self._beams is None or self._beams[0] != key:
            with np.errstate(invalid="ignore", over="ignore"):  # angles that are none are drawn nowhere
                self._beams = key, key[0] + key[1] * np.arange(count, dtype=np.float64)
        return self._beams[1]

    def _low(self) -> bool:
        return bool(self.width > LOW * self.height)

    def _place(self, half: float) -> tuple[float, float, float]:
        """Where the robot stands [px], and the scale [px/m], so that all rings are inside the card."""
        behind = max(0.12, -math.cos(half))
        beside = 1.0 if half >= AHEAD else math.sin(half)
        # in a low card the name stands beside the rings, not above them
        edge, head = dp(14), dp(14) if self._low() else dp(34)
        wide, high = self.width - 2 * edge, self.height - edge - head
        radius = max(min(wide / (2 * beside), high / (1 + behind)), 1.0)
        slack = (high - radius * (1 + behind)) / 2
        return self.center_x, self.y + edge + slack + radius * behind, radius / self._reach

    def _rings(self, shapes: Shapes, at: tuple[float, float], scale: float, half: float) -> None:
        angles = np.linspace(AHEAD - half, AHEAD + half, 97)
        rim = np.stack([np.cos(angles), np.sin(angles)], axis=1) * self._reach * scale
        for ring in range(1, RINGS + 1):
            shapes.line(rim * ring / RINGS + at, dp(1.2), theme.line)

    def _ring_words(self, at: tuple[float, float], scale: float, half: float) -> Iterator[Word]:
        """Distances ahead, on their rings; only the outer one where they would cover each other."""
        radius, size = self._reach * scale, sp(11.5)
        if self._low():  # beside the ring, where there is room, since above it stands the name
            x = at[0] + radius * math.sin(min(half, AHEAD)) + dp(6)
            y = at[1] + radius * math.cos(min(half, AHEAD)) + dp(4)
            yield Word(length_text(round(self._reach, 2)), x, y, size, theme.muted, anchor=(0, 0))
            return
        for ring in range(1, RINGS + 1):
            if ring == RINGS or radius / RINGS > sp(26):
                text = length_text(round(self._reach * ring / RINGS, 2))
                yield Word(text, at[0], at[1] + radius * ring / RINGS, size, theme.muted)

    def _header(self) -> Iterator[Word]:
        yield from self._name()
        # an alarm has its sign in the corner
        alarm = self.state == "alarm"
        right, y = self.right - (dp(34) if alarm else dp(13)), self.top - dp(19)
        if math.isnan(self.nearest):
            yield Word(DASH, right, y, sp(14), theme.muted, anchor=(1, 0.5))
        elif self.nearest < self.near:
            colour = theme.danger if self.nearest < self.close else theme.warn
            yield Word(
                " ".join(said(self.nearest, "height", 1)),
                right,
                y,
                sp(14),
                colour,
                bold=True,
                anchor=(1, 0.5),
            )
            if self.nearest < self.close and not alarm:
                yield Word(
                    icon("warning"), right - sp(52), y, sp(16), colour, font=theme.icons, anchor=(0.5, 0.5)
                )

    def _name(self) -> Iterator[Word]:
        """The title and the rate behind it, or below it in a low card, where the rings begin."""
        rate = "" if math.isnan(self.rate) else f"{self.rate:.0f} HZ"
        lines = (
            [tr(self.title).upper(), rate]
            if self._low()
            else [" · ".join(filter(None, (tr(self.title).upper(), rate)))]
        )
        for number, line in enumerate(filter(None, lines)):
            y = self.top - dp(19) - sp(16) * number
            yield Word(line, self.x + dp(13), y, sp(12), theme.muted, anchor=(0, 0.5))


def _half(angles: NDArray[np.float64]) -> float:
    """How far a sweep goes to both sides [rad]."""
    return min(max(abs(float(angles[0])), abs(float(angles[-1]))), math.pi) if len(angles) else math.pi


def _farthest(seen: NDArray[np.float32], range_max: float) -> float:
    """Distance that nine in ten returns do not exceed [m]; the sensor's own range when it sees nothing."""
    return not_exceeded_by(seen, 0.9) if len(seen) else min(max(range_max, 1.0), 6.0)


def _scan(*, around: bool = False, step_back: float = 0.0) -> LaserScan:
    """A room with a post to the left, a wall to the right, and gaps."""
    half = math.pi if around else AHEAD
    angles = np.linspace(-half, half, 360 if around else 181)
    ranges = 3.1 + 1.3 * np.sin(angles * 3.0) + 0.9 * np.cos(angles * 5.0) + step_back
    ranges[np.abs(angles - 0.5) < 0.10] = 1.05 + step_back
    ranges[np.abs(angles + 1.3) < 0.12] = 0.5 + step_back
    ranges[np.abs(angles + 0.3) < 0.06] = math.inf
    ranges[np.abs(angles - 1.1) < 0.05] = math.nan
    return LaserScan(
        angle_min=-half,
        angle_max=half,
        angle_increment=float(angles[1] - angles[0]),
        range_min=0.1,
        range_max=12.0,
        ranges=Float32Array(ranges.tolist()),
    )


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""

    def made(
        scan: LaserScan | None = None, size: tuple[float, float] = (326, 228), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> LaserScanView:
            view = LaserScanView(
                size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **{"title": "Front laser", **more}
            )
            if scan:
                view.show(scan)
            return view

        return build

    return {
        "never": made(),
        "live": made(_scan(), state="live", rate=30.0),
        "clear": made(_scan(step_back=3.0), state="live", rate=30.0),
        "around": made(_scan(around=True), state="live", rate=10.0, size=(300, 320), title="Laser"),
        "low": made(_scan(around=True), state="live", rate=10.0, size=(258, 118), title="Laser"),
        "small": made(_scan(around=True), state="live", rate=10.0, size=(212, 148), title="Laser"),
        "half low": made(_scan(step_back=5.0), state="live", rate=10.0, size=(258, 118)),
        "stale": made(_scan(), state="stale", age=2.0),
        "alarm": made(_scan(), state="alarm", rate=30.0),
        "disabled": made(_scan(), state="disabled"),
    }
