"""Geometry of the instruments: dials, tapes, laser sweeps, views of a map. Nothing is drawn in here.

Screen coordinates are Kivy's: pixels, x to the right, y up. World coordinates are the `map` frame's: metres,
x east, y north. A colour is four floats, red, green, blue, alpha, 0 to 1.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bridge.core.units import heading_from_yaw, yaw_from_heading
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu
from widgets.core.language import brief_figure, mark, tr
from widgets.core.quantities import quantities, to_shown, unit_of

__all__ = [
    "CARDINALS",
    "DASH",
    "HULL",
    "Trail",
    "View",
    "cover",
    "contain",
    "dial_point",
    "dial_text",
    "heading_of",
    "heading_text",
    "horizon_rise",
    "length_text",
    "nearest",
    "nice_floor",
    "not_exceeded_by",
    "rounded",
    "scan_points",
    "scan_reach",
    "screen_angle",
    "shortest_turn",
    "spread",
    "steady",
    "tape_marks",
    "thinned",
    "tween",
]

Points = NDArray[np.float64]
"""Shape (n, 2)."""

CARDINALS: dict[int, str] = {
    0: mark("N", "compass"),
    90: mark("E", "compass"),
    180: mark("S", "compass"),
    270: mark("W", "compass"),
}
"""Letters of the four main headings [deg]."""

NORTHERN = ("map", "world", "earth", "utm")
"""Frames whose x axis points east, by their last names; a pose that names none is in `map`."""
DASH = "–"
"""What a value that is not known looks like."""


_SIDE = ((0.0, 1.0), (0.2, 0.72), (0.3, 0.3), (0.32, -0.3), (0.26, -0.78))
HULL = (*_SIDE, *((-across, ahead) for across, ahead in reversed(_SIDE[1:])))
"""A boat from above from its bow clockwise, in half lengths: to the right, ahead."""


@dataclass(frozen=True, slots=True)
class View:
    """How the world lies on the screen: turned, enlarged and shifted, never sheared.

    As complex numbers, screen = `turn_scale` * world + `offset`.
    """

    turn_scale: complex = 20 + 0j
    """Its length is the scale [px/m], its angle the turn of the world on the screen [rad], anticlockwise."""
    offset: complex = 0j
    """Where the world's origin is on the screen [px]."""

    @classmethod
    def centred(cls, x: float, y: float, *, at: tuple[float, float], scale: float, turn: float = 0.0) -> View:
        """The view that shows world point (x, y) [m] at the screen point `at` [px]."""
        turn_scale = cmath.rect(scale, turn)
        return cls(turn_scale, complex(*at) - turn_scale * complex(x, y))

    @property
    def scale(self) -> float:
        """Pixels to a metre."""
        return abs(self.turn_scale)

    @property
    def turn(self) -> float:
        """How far the world is turned on the screen [rad], anticlockwise."""
        return cmath.phase(self.turn_scale)

    def to_screen(self, x: float, y: float) -> tuple[float, float]:
        """Where world point (x, y) [m] is on the screen [px]."""
        z = self.turn_scale * complex(x, y) + self.offset
        return z.real, z.imag

    def to_world(self, px: float, py: float) -> tuple[float, float]:
        """Which world point [m] is at the screen point (px, py) [px]."""
        z = (complex(px, py) - self.offset) / self.turn_scale
        return z.real, z.imag

    def many_to_screen(self, points: Points) -> Points:
        """The same as `to_screen` for an array of shape (n, 2)."""
        a, b = self.turn_scale, self.offset
        matrix = np.array([[a.real, a.imag], [-a.imag, a.real]])
        return np.asarray(points @ matrix + (b.real, b.imag))

    def moved(self, dx: float, dy: float) -> View:
        """The view after the world was dragged by (dx, dy) [px]."""
        return View(self.turn_scale, self.offset + complex(dx, dy))

    def zoomed(self, factor: float, px: float, py: float) -> View:
        """The view enlarged `factor` times about the screen point (px, py), which stays where it is."""
        at = complex(px, py)
        return View(self.turn_scale * factor, (self.offset - at) * factor + at)

    def pinched(
        self,
        before: tuple[complex, complex],
        after: tuple[complex, complex],
        *,
        may_turn: bool = True,
    ) -> View:
        """The view after two fingers went from `before` to `after` [px]: what was under each stays under it.

        Without `may_turn` the world keeps its turn and the middle between the fingers is followed.
        """
        was, now = before[1] - before[0], after[1] - after[0]
        if abs(was) < 1.0 or abs(now) < 1.0:
            return self
        change = now / was if may_turn else complex(abs(now) / abs(was))
        middle_was, middle_now = sum(before) / 2, sum(after) / 2
        return View(self.turn_scale * change, (self.offset - middle_was) * change + middle_now)

    def within(self, least: float, greatest: float, px: float, py: float) -> View:
        """The view with its scale brought into [least, greatest] [px/m] about the screen point (px, py)."""
        wanted = min(max(self.scale, least), greatest)
        return self if wanted == self.scale else self.zoomed(wanted / self.scale, px, py)

    @classmethod
    def fitting(
        cls, points: Points, *, box: tuple[float, float, float, float], turn: float = 0.0, most: float = 200.0
    ) -> View:
        """The view that shows all `points` [m] inside `box` (x, y, width, height) [px], `most` [px/m] at most."""
        turned = points @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
        low, high = turned.min(axis=0), turned.max(axis=0)
        spans = np.maximum(high - low, 1e-6)
        scale = float(min(box[2] / spans[0], box[3] / spans[1], most))
        middle = complex(*((low + high) / 2)) * cmath.rect(1.0, -turn)
        at = (box[0] + box[2] / 2, box[1] + box[3] / 2)
        return cls.centred(middle.real, middle.imag, at=at, scale=scale, turn=turn)


class Trail:
    """Where something has been: the newest `most` points, each at least `apart` [m] from the one before."""

    def __init__(self, most: int = 2000, apart: float = 0.05) -> None:
        self._most, self._apart = most, apart
        self._buffer = np.zeros((2 * most, 2))
        self._first = self._end = 0

    @property
    def points(self) -> Points:
        """Oldest first, shape (n, 2) [m]."""
        return self._buffer[self._first : self._end]

    def replace(self, points: Points) -> None:
        """Have been at these places instead, shape (n, 2) [m], oldest first; of too many each so-many-th and the last."""
        step = max(1, -(-len(points) // self._most))
        kept = points[(len(points) - 1) % step :: step]
        self._first, self._end = 0, len(kept)
        self._buffer[: self._end] = kept

    def add(self, x: float, y: float) -> bool:
        """Go on to (x, y) [m]; False when that is too near to tell, or not a place."""
        if not (math.isfinite(x) and math.isfinite(y)):
            return False
        if self._end and math.hypot(*(self._buffer[self._end - 1] - (x, y))) < self._apart:
            return False
        if self._end == len(self._buffer):
            self._buffer[: self._most] = self._buffer[self._first :]
            self._first, self._end = 0, self._most
        self._buffer[self._end] = x, y
        self._end += 1
        self._first = max(self._first, self._end - self._most)
        return True


def screen_angle(yaw: float) -> float:
    """The angle [deg, anticlockwise from the right] at which a Kivy `Rotate` shows `yaw` [rad]."""
    return (90.0 - heading_from_yaw(yaw)) % 360.0


def shortest_turn(start: float, end: float) -> float:
    """How far to turn from heading `start` to `end` [deg], in [-180, 180): 359 to 0 is +1."""
    return (end - start + 180.0) % 360.0 - 180.0


def heading_of(msg: Imu | Odometry | PoseWithCovarianceStamped) -> float:
    """Heading [deg] of the bow in a message; NaN for an Imu that measures no orientation, and in a frame that has no north.

    Wheels begin to count where the robot stood and however it was turned: `odom` has none, `map` has.
    """
    if isinstance(msg, Imu):
        known = msg.orientation_covariance[:1] != [-1]
        return heading_from_yaw(msg.orientation.yaw) if known else math.nan
    frame = msg.header.frame_id.rsplit("/", 1)[-1]
    if frame not in NORTHERN and (frame or isinstance(msg, Odometry)):
        return math.nan
    return heading_from_yaw(msg.pose.pose.orientation.yaw)


def horizon_rise(pitch: float, radius: float, rung: float) -> float:
    """How far `pitch` [rad, positive nose down] raises a level view on an instrument of `radius` [px].

    `rung` is the share of the radius that stands for ten degrees.
    """
    return shortest_turn(heading_from_yaw(pitch), 90.0) / 10.0 * rung * radius


def dial_point(bearing: float, radius: float, heading: float = 0.0) -> tuple[float, float]:
    """Where `bearing` [deg] is on a dial with `heading` [deg] at its top, from the dial's centre."""
    angle = yaw_from_heading(bearing - heading)
    return radius * math.cos(angle), radius * math.sin(angle)


def dial_text(bearing: int) -> str:
    """What a compass card says at `bearing` [deg, a multiple of 30]: N, E, S, W or tens of degrees."""
    return tr(CARDINALS.get(bearing % 360, "")) or str(bearing % 360 // 10)


def heading_text(heading: float) -> str:
    """`heading` [deg] as three figures and a degree sign; a dash when it is NaN."""
    return DASH if math.isnan(heading) else f"{round(heading) % 360:03d}°"


def tape_marks(heading: float, span: float, step: int = 5) -> list[int]:
    """The multiples of `step` [deg] within `span` / 2 of `heading`; they may be below 0 or above 359."""
    first = math.ceil((heading - span / 2) / step)
    last = math.floor((heading + span / 2) / step)
    return [step * index for index in range(first, last + 1)]


def steady(shown: float, value: float, step: float) -> float:
    """`value`, or what is `shown` already where that is less than `step` away: noise that nobody sees draws nothing anew."""
    return shown if abs(value - shown) < step else value


def nice_floor(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above `value` (> 0)."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(n * power for n in (5.0, 2.0, 1.0) if n * power <= value * (1 + 1e-9))


def length_text(metres: float) -> str:
    """A length with its unit: `20 cm`, `5 m`, `2 km`; in another unit of the operator's to one decimal."""
    if quantities.system == "imperial":
        return f"{brief_figure(round(to_shown(metres, 'height'), 1))} {unit_of('height')}"
    if metres < 1.0:
        return f"{brief_figure(metres * 100)} cm"
    return f"{brief_figure(metres)} m" if metres < 1000.0 else f"{brief_figure(metres / 1000)} km"


def rounded(left: float, low: float, width: float, height: float, radius: float) -> Points:
    """Corners of a rectangle with round corners of `radius`, anticlockwise, shape (n, 2); the same lengths as given."""
    radius = min(radius, width / 2, height / 2)
    quarter = np.linspace(0.0, math.pi / 2, 6)
    arcs = []
    for number, (x, y) in enumerate(((1, 1), (0, 1), (0, 0), (1, 0))):
        middle = left + radius + x * (width - 2 * radius), low + radius + y * (height - 2 * radius)
        angles = quarter + number * math.pi / 2
        arcs.append(np.stack([np.cos(angles), np.sin(angles)], axis=1) * radius + middle)
    return np.concatenate(arcs)


def cover(width: float, height: float, wide: float, high: float) -> tuple[float, float]:
    """The size at which a picture of (width, height) fills a frame (wide, high) and keeps its shape."""
    factor = max(wide / width, high / height)
    return width * factor, height * factor


def contain(width: float, height: float, wide: float, high: float) -> tuple[float, float]:
    """The size at which a picture of (width, height) fits whole into a frame (wide, high)."""
    factor = min(wide / width, high / height)
    return width * factor, height * factor


def nearest(points: Sequence[tuple[float, float]], x: float, y: float, reach: float) -> int:
    """The index of the point nearest to (x, y) and within `reach` of it; -1 when there is none."""
    best, found = reach, -1
    for index, (px, py) in enumerate(points):
        distance = math.hypot(px - x, py - y)
        if distance <= best:
            best, found = distance, index
    return found


def tween(first: Sequence[float], second: Sequence[float], share: float) -> tuple[float, ...]:
    """The colour `share` of the way from `first` to `second`."""
    return tuple(a + (b - a) * share for a, b in zip(first, second, strict=True))


def scan_points(
    ranges: Iterable[float], angle_min: float, angle_increment: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], Points]:
    """Ranges [m], directions [rad] and points [m, x ahead, y left] of a sweep; what is not finite stays so."""
    measured = np.asarray(ranges, dtype=np.float64)
    angles: NDArray[np.float64] = angle_min + angle_increment * np.arange(len(measured), dtype=np.float64)
    units = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    with np.errstate(invalid="ignore"):
        return measured, angles, units * measured[:, None]


REACHES = (1.5, 3.0, 6.0, 9.0, 12.0, 15.0, 24.0, 30.0, 60.0)
"""Distances [m] that a laser's picture may end at; each has three rings at round distances."""


def scan_reach(farthest: float, before: float = 0.0) -> float:
    """How far the picture of a sweep should go that sees to `farthest` [m]; it grows at once and shrinks late."""
    wanted = next((reach for reach in REACHES if reach >= farthest), REACHES[-1])
    return before if wanted < before < 1.6 * farthest else wanted


def not_exceeded_by(values: NDArray[np.floating[Any]], share: float) -> float:
    """What a `share` of the values, 0 to 1, does not exceed, between two of them in proportion; ValueError for none.

    As numpy's percentile, which loads a megabyte for masked arrays when it is first asked.
    """
    if not len(values):
        raise ValueError(tr("There are no values of which a share could be taken."))
    place = (len(values) - 1) * share
    low = math.floor(place)
    high = min(low + 1, len(values) - 1)
    ordered = np.partition(values, (low, high))
    return float(ordered[low] + (ordered[high] - ordered[low]) * (place - low))


def thinned(points: Points, apart: float) -> Points:
    """A line without the points that come before it has gone on by `apart`; its ends stay."""
    if len(points) < 3:
        return points
    steps = np.hypot(*np.diff(points, axis=0).T)
    reached = np.floor(np.cumsum(steps) / apart)
    kept = np.concatenate([[True], np.diff(reached, prepend=0.0) > 0])
    kept[-1] = True
    return np.asarray(points[kept])


def spread(points: Iterable[tuple[float, float]]) -> Points:
    """Pairs as an array of shape (n, 2), without those that have a NaN in them."""
    array = np.array([*points], dtype=np.float64).reshape(-1, 2)
    return array[np.isfinite(array).all(axis=1)]
