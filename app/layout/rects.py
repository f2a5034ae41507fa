"""Rectangles on the glass, and where STOP goes in one.

Pure arithmetic in the window's pixels, origin at the lower left.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["ALL", "Body", "Rect", "StopPlace", "between", "crowded", "stop_place", "stop_tall"]

ALL = 54
"""Height of STOP ALL where it is above something [dp]."""


@dataclass(frozen=True, slots=True)
class Rect:
    """A place on the glass [px]."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """x of the right edge [px]."""
        return self.x + self.width

    @property
    def top(self) -> float:
        """y of the upper edge [px]."""
        return self.y + self.height

    def overlaps(self, other: Rect) -> bool:
        """Whether the two share any pixel."""
        return self.x < other.right and other.x < self.right and self.y < other.top and other.y < self.top

    def holds(self, other: Rect) -> bool:
        """Whether `other` lies within."""
        inside = self.x <= other.x and other.right <= self.right + 1e-6
        return inside and self.y <= other.y and other.top <= self.top + 1e-6


@dataclass(frozen=True, slots=True)
class Body(Rect):
    """The room of a screen between bar and navigation."""

    crowded: bool = False
    """STOP ALL is in STOP's corner as well."""


@dataclass(frozen=True, slots=True)
class StopPlace(Rect):
    """Where STOP is, the largest thing to press, and the smaller STOP ALL beside or above it."""

    other: Rect | None = None
    """Where STOP ALL is; None where there is none."""

    @property
    def left(self) -> float:
        """x of the left edge of both [px]."""
        return self.x if self.other is None else min(self.x, self.other.x)

    @property
    def head(self) -> float:
        """y of the upper edge of both [px]."""
        return self.top if self.other is None else max(self.top, self.other.top)


def crowded(body: Rect) -> bool:
    """STOP ALL is in STOP's corner as well."""
    return isinstance(body, Body) and body.crowded


def stop_place(room: Rect, body: Rect, dp: float) -> StopPlace:
    """STOP in the room that it has alone, or together with STOP ALL: beside each other, or one above the other."""
    gap = 8 * dp
    if not crowded(body):
        return StopPlace(room.x, room.y, room.width, room.height)
    if room.width >= 1.3 * room.height:
        small = (84 if room.width >= 250 * dp else 54) * dp
        other = Rect(room.x, room.y, small, room.height)
        return StopPlace(room.x + small + gap, room.y, room.width - small - gap, room.height, other)
    low = room.height - ALL * dp - gap
    return StopPlace(room.x, room.y, room.width, low, Rect(room.x, room.y + low + gap, room.width, ALL * dp))


def between(left: float, low: float, right: float, top: float) -> Rect:
    """The rectangle within these edges [px]."""
    return Rect(left, low, right - left, top - low)


def stop_tall(body: Rect, gap: float, dp: float) -> tuple[StopPlace, Rect]:
    """STOP in an upright screen's corner, and the strip beside it; STOP ALL is above the strip, and STOP grows with it."""
    width, height = min(max(158 * dp, body.width * 0.43), 260 * dp), 118 * dp
    x = body.right - gap - width
    strip = Rect(body.x + gap, body.y + gap, x - body.x - 2 * gap, height)
    if not crowded(body):
        return StopPlace(x, strip.y, width, height), strip
    other = Rect(strip.x, strip.top + 8 * dp, strip.width, ALL * dp)
    return StopPlace(x, strip.y, width, other.top - strip.y, other), strip
