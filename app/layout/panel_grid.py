"""Arithmetic of the grid that free panels lie on: cells, sizes, packing, and how a moved panel pushes the others down.

A place counts cells from the upper left corner. Each form of the window has a number of columns, and of rows that fill it;
what lies lower is scrolled to.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

__all__ = [
    "COLUMNS",
    "FORMS",
    "MAX_ROWS",
    "ROWS",
    "Place",
    "arrange",
    "clamped",
    "free_place",
    "height_of",
    "settled",
    "usual_size",
]

FORMS = ("wide", "short", "tall")
"""Forms of a window, as in `app.layout.arrange.form`: a tablet, a phone on its side, a phone upright."""
COLUMNS = {"wide": 12, "short": 12, "tall": 6}
"""Across the window."""
ROWS = {"wide": 12, "short": 6, "tall": 12}
"""That fill the window's height."""
MAX_ROWS = 120
"""Of a view, as far as it is scrolled."""

_FIGURES = ("Readout",)
_SWITCHES = ("ToggleSwitch", "TickBox", "MomentaryButton")
_ROUND = (
    *("Compass", "ArtificialHorizon", "Joystick", "TiltCircle", "GoalPad", "CourseDial", "HeadingDial"),
    *("RollPitch", "AckermannView", "Battery", "LinkQuality", "DepthGauge", "HeightTape", "SonarRingView"),
    *("UltrasoundView", "LiftLever", "DPad", "RotorSpeeds", "LegPanel", "RudderThrottle", "EncodersView"),
)
_LOW = ("HeadingTape", "TurnTape", "SlideToConfirm", "LineSensorView", "SpeedCard")
_SIZES: Mapping[str, Mapping[str, tuple[int, int]]] = {
    "figure": {"wide": (2, 2), "short": (2, 2), "tall": (2, 2)},
    "switch": {"wide": (3, 2), "short": (3, 2), "tall": (3, 2)},
    "round": {"wide": (3, 4), "short": (3, 3), "tall": (3, 3)},
    "low": {"wide": (4, 2), "short": (4, 2), "tall": (6, 2)},
    "broad": {"wide": (6, 4), "short": (6, 3), "tall": (6, 3)},
}


class Place(NamedTuple):
    """Where a panel is [cells]."""

    left: int
    top: int
    """From the upper edge downwards."""
    width: int
    height: int

    @property
    def right(self) -> int:
        """The first column that is free beside it."""
        return self.left + self.width

    @property
    def bottom(self) -> int:
        """The first row that is free below it."""
        return self.top + self.height

    def overlaps(self, other: Place) -> bool:
        """The two share a cell."""
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom


def usual_size(widget: str, form: str) -> tuple[int, int]:
    """Columns and rows that a widget of that name is well seen in."""
    kinds = (("figure", _FIGURES), ("switch", _SWITCHES), ("round", _ROUND), ("low", _LOW))
    kind = next((kind for kind, names in kinds if widget in names), "broad")
    return _SIZES[kind][form]


def clamped(place: Place, form: str) -> Place:
    """The nearest place that lies on the grid."""
    columns = COLUMNS[form]
    width, height = min(max(place.width, 1), columns), min(max(place.height, 1), MAX_ROWS)
    left = min(max(place.left, 0), columns - width)
    return Place(left, min(max(place.top, 0), MAX_ROWS - height), width, height)


def free_place(size: tuple[int, int], taken: Iterable[Place], form: str) -> Place:
    """The first place of that size that none of `taken` overlaps, row by row; below all of them at the latest."""
    width, height = min(size[0], COLUMNS[form]), size[1]
    others = list(taken)
    for top in range(max((one.bottom for one in others), default=0) + 1):
        for left in range(COLUMNS[form] - width + 1):
            place = Place(left, top, width, height)
            if not any(place.overlaps(other) for other in others):
                return place
    return Place(0, max((one.bottom for one in others), default=0), width, height)


def arrange(panels: Sequence[tuple[str, Place | None]], form: str) -> list[Place]:
    """A place for each panel of that widget: the one set by hand where there is one, else the first that is free.

    Where none is set by hand and half the window or more would be left empty, all are made higher.
    """
    found: list[Place | None] = [None if place is None else clamped(place, form) for _, place in panels]
    by_hand = any(place is not None for place in found)
    taken = [place for place in found if place is not None]
    for index, (widget, _) in enumerate(panels):
        if found[index] is None:
            place = free_place(usual_size(widget, form), taken, form)
            found[index] = place
            taken.append(place)
    places = [place for place in found if place is not None]
    grown = 1 if by_hand else max(1, ROWS[form] // max(height_of(places), 1))
    return [Place(one.left, one.top * grown, one.width, one.height * grown) for one in places]


def height_of(places: Iterable[Place]) -> int:
    """Rows down to the lowest edge of any."""
    return max((place.bottom for place in places), default=0)


def settled(places: Sequence[Place], moved: int) -> list[Place]:
    """The same places where the one that was `moved` stays, and those that it overlaps make room downwards."""
    result = list(places)
    fixed = [places[moved]]
    others = [index for index in range(len(places)) if index != moved]
    for index in sorted(others, key=lambda one: (places[one].top, places[one].left)):
        place = result[index]
        while clash := [one for one in fixed if place.overlaps(one)]:
            place = place._replace(top=max(one.bottom for one in clash))
        result[index] = place
        fixed.append(place)
    return result
