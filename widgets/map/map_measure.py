"""Measuring on a map: a finger taps places, and the ways between them say how long they are and where they lead.

map.mode = "measure"
map.measured     # [(0.0, 0.0), (3.0, 4.0)]: x, y in `map` [m]
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from kivy.input import MotionEvent
from kivy.metrics import dp, sp
from kivy.properties import ListProperty

from bridge.core.units import heading_from_yaw
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import View
from widgets.core.language import tr
from widgets.core.quantities import said
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.map.map_gestures import Grip, MapGestures

__all__ = ["MeasuringMap", "bearing", "leg_words", "measure_marks", "total_words"]

MAX_POINTS = 50
"""Places that are measured at once; the next tap begins anew."""
DOT = 7.0
"""Radius of a place that is measured [dp]."""

Place = tuple[float, float]


class MeasuringMap(MapGestures):
    """Fingers on a map that can measure."""

    measured: ListProperty[Place] = ListProperty()
    """Places in the order they were tapped, (x, y) in `map` [m]; none unless `mode` is `measure`."""

    def _things(self) -> list[tuple[str, list[Any]]]:
        if self.mode == "measure":
            return [("measured", list(self.measured))]
        return super()._things()

    def _tap(self, touch: MotionEvent, grip: Grip | None) -> None:
        if self.mode != "measure":
            super()._tap(touch, grip)
        elif grip is None:
            before = self.measured if len(self.measured) < MAX_POINTS else []
            self.measured = [*before, self.view.to_world(*touch.pos)]

    def _drop(self, grip: Grip) -> None:
        if grip.what == "measured" and grip.index < len(self.measured):
            self.measured[grip.index] = (grip.x, grip.y)
        else:
            super()._drop(grip)

    def measured_now(self) -> list[Place]:
        """The places, with the one in a finger's grip where the finger is."""
        places, grip = list(self.measured), self.grip
        if grip is not None and grip.what == "measured" and grip.index < len(places):
            places[grip.index] = (grip.x, grip.y)
        return places


def bearing(start: Place, end: Place) -> float:
    """Where the way leads, clockwise from north [deg], 0 to 360."""
    return heading_from_yaw(math.atan2(end[1] - start[1], end[0] - start[0])) % 360.0


def leg_words(start: Place, end: Place) -> str:
    """How long one way is, in the operator's unit, and where it leads."""
    return f"{said(math.dist(start, end), 'length').words} · {round(bearing(start, end)) % 360:03d}°"


def total_words(places: Sequence[Place]) -> str:
    """How long all ways are together; empty for fewer than two places."""
    if len(places) < 2:
        return ""
    long = sum(math.dist(a, b) for a, b in itertools.pairwise(places))
    if len(places) == 2:
        return leg_words(places[0], places[1])
    return tr("{length} in all").format(length=said(long, "length").words)


def measure_marks(shapes: Shapes, view: View, places: Sequence[Place]) -> Iterator[Word]:
    """The places, the ways between them and the words of each, upright however the map is turned."""
    if not places:
        return
    seen = view.many_to_screen(np.array(places, dtype=np.float64))
    if len(seen) > 1:
        shapes.line(seen, dp(6), tint(theme.bg, 0.6))
        shapes.line(seen, dp(2.4), theme.text)
    for x, y in seen:
        shapes.disc(x, y, dp(DOT) + dp(2), theme.bg)
        shapes.ring(x, y, dp(DOT), dp(2.4), theme.text)
    for (start, end), (a, b) in zip(itertools.pairwise(places), itertools.pairwise(seen), strict=True):
        if math.dist(a, b) < dp(60):
            continue  # its words would cover it
        x, y = (float(value) for value in (a + b) / 2)
        word = Word(leg_words(start, end), x, y, sp(13), theme.text, bold=True)
        ground(shapes, word, tint(theme.bg, 0.85))
        yield word
