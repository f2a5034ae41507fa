"""Rectangles on the glass, and where STOP goes in one.

Pure arithmetic in the window's pixels, origin at the lower left.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar

__all__ = [
    "ALL",
    "ALL_BESIDE",
    "EDGE",
    "Body",
    "Rect",
    "StopPlace",
    "all_mirrored",
    "between",
    "crowded",
    "handed",
    "left_handed",
    "right_handed",
    "mirrored",
    "stop_place",
    "stop_tall",
]

ALL = 54
"""Height of STOP ALL where it is above something [dp]."""
ALL_BESIDE = 72
"""Width of STOP ALL beside STOP on a phone's side [dp]: 11 mm, in which its words keep clear of its border."""
EDGE = 12
"""From STOP to the edges of the body in its corner [dp]."""
STOP = {
    "wide": (0.48, -258, 190, 381, 96, 0.2),
    "short": (0.2, 0, 130, 160, 96, 0.27),
    "tall": (0.32, 0, 112, 240, 158, 0.24),
}
"""Size of STOP by the shape of the window: width as a share of the body's and what is added to that, the least and the most of
it, height [dp], and the greatest share of the body's height."""


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
    left_hand: bool = False
    """The left hand holds STOP: what is arranged by hand is mirrored."""
    target: float = 0.0
    """Least size of STOP and of STOP ALL: what a finger hits, in gloves too [px]."""


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
    def end(self) -> float:
        """x of the right edge of both [px]."""
        return self.right if self.other is None else max(self.right, self.other.right)

    @property
    def head(self) -> float:
        """y of the upper edge of both [px]."""
        return self.top if self.other is None else max(self.top, self.other.top)


R = TypeVar("R", bound=Rect)


def crowded(body: Rect) -> bool:
    """STOP ALL is in STOP's corner as well."""
    return isinstance(body, Body) and body.crowded


def stop_place(body: Rect, shape: str, dp: float, *, beside: float = 0.0) -> StopPlace:
    """STOP in the lower right corner: its rectangle follows from the body alone, so that it is the same on every screen.

    STOP ALL takes nothing of it: it is above, or where `beside` says how wide [px], left of it. `shape` is that of the window.
    """
    target = body.target if isinstance(body, Body) else 0.0
    share, added, least, most, high, part = STOP[shape]
    width = max(min(max(share * body.width + added * dp, least * dp), most * dp), target)
    height, gap = max(min(high * dp, part * body.height), target), 8 * dp
    x, y = body.right - EDGE * dp - width, body.y + EDGE * dp
    if not crowded(body):
        return StopPlace(x, y, width, height)
    if beside:
        small = max(beside, target)
        return StopPlace(x, y, width, height, Rect(x - gap - small, y, small, height))
    return StopPlace(x, y, width, height, Rect(x, y + height + gap, width, max(ALL * dp, target)))


def between(left: float, low: float, right: float, top: float) -> Rect:
    """The rectangle within these edges [px]."""
    return Rect(left, low, right - left, top - low)


def stop_tall(body: Rect, dp: float) -> tuple[StopPlace, Rect]:
    """STOP in an upright screen's corner, and the strip beside it, as high as STOP and what is above it."""
    stop, gap = stop_place(body, "tall", dp), EDGE * dp
    return stop, between(body.x + gap, stop.y, stop.x - gap, stop.head)


P = ParamSpec("P")


def handed(
    arrange: Callable[Concatenate[Rect, P], dict[str, Rect]],
) -> Callable[Concatenate[Rect, P], dict[str, Rect]]:
    """Have what `arrange` places for a right hand mirrored in a body for the left one; it always sees a body for the right."""

    @wraps(arrange)
    def for_hand(body: Rect, /, *args: P.args, **kwargs: P.kwargs) -> dict[str, Rect]:
        if not left_handed(body):
            return arrange(body, *args, **kwargs)
        return all_mirrored(arrange(right_handed(body), *args, **kwargs), body)

    return for_hand


def left_handed(body: Rect) -> bool:
    """What is arranged by hand is to be mirrored in it."""
    return isinstance(body, Body) and body.left_hand


def right_handed(body: Rect) -> Rect:
    """The same body for a right hand."""
    return replace(body, left_hand=False) if isinstance(body, Body) else body


def all_mirrored(places: dict[str, Rect], room: Rect) -> dict[str, Rect]:
    """Each of them as of `mirrored`."""
    return {name: mirrored(place, room) for name, place in places.items()}


def mirrored(place: R, room: Rect) -> R:
    """The same place seen in a mirror that stands upright in the middle of `room`."""
    x = room.x + room.right - place.right
    if isinstance(place, StopPlace) and place.other is not None:
        return replace(place, x=x, other=mirrored(place.other, room))
    return replace(place, x=x)
