"""Geometry of the small sensors: the offset of a line, the aim of a ranger, distances in words. Nothing is drawn in here."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from widgets.core.language import mark, tr
from widgets.core.quantities import said

__all__ = ["aim", "ago_text", "away_text", "contrast_of", "line_offset", "side_text", "wheel_name"]

MIN_CONTRAST = 0.25
"""Between the brightest and the darkest cell; less is one ground with dirt on it."""

_AIMS = {"rear": math.pi, "back": math.pi, "aft": math.pi, "left": math.pi / 2, "right": -math.pi / 2}
_AHEAD = ("front", "fore", "ahead")
SIDES = {
    "left": mark("left"),
    "right": mark("right"),
    "front": mark("front"),
    "rear": mark("rear"),
    "middle": mark("middle"),
}
"""Words in the name of a joint that people read."""
STRAIGHT = math.radians(10)
"""What is not farther aside than this is ahead or behind [rad]."""


def contrast_of(values: Iterable[float]) -> float:
    """Brightest less darkest of a line sensor's cells, 0 to 1; NaN when none of them has a value."""
    known = [value for value in values if math.isfinite(value)]
    return max(known) - min(known) if known else math.nan


def line_offset(values: Iterable[float], spacing: float) -> float:
    """Where the middle of the line is from the middle of the cells [m], positive to the left; NaN without a line.

    `values` are of cells from left to right, 0 dark to 1 bright. The line is what fewer cells see: bright on a dark ground,
    or dark on a bright one.
    """
    light = np.asarray(list(values), dtype=np.float64)
    known = np.isfinite(light)
    if not contrast_of(light) >= MIN_CONTRAST:
        return math.nan
    middle = (light[known].max() + light[known].min()) / 2
    bright = np.where(known, light - middle, 0.0)
    if (bright > 0).sum() > known.sum() / 2:
        bright = -bright
    weights = np.maximum(bright, 0.0)
    places = ((len(light) - 1) / 2 - np.arange(len(light))) * spacing
    return float((weights * places).sum() / weights.sum())


def aim(frame: str) -> float:
    """Which way a ranger looks by the words in the name of its frame [rad, positive left]; ahead when they say nothing.

    `ultrasound_front_left` looks half to the left.
    """
    name = frame.lower()
    found = [angle for word, angle in _AIMS.items() if word in name]
    ahead = any(word in name for word in _AHEAD)
    if not found:
        return 0.0
    aside = next((angle for angle in found if abs(angle) < 3.0), None)
    if aside is None:
        return math.pi
    if any(abs(angle) > 3.0 for angle in found):
        return math.copysign(0.75 * math.pi, aside)
    return aside / 2 if ahead else aside


def away_text(metres: float) -> str:
    """A distance as one reads it at a glance, in the operator's unit: `0.42 m`, `4.2 m`, `120 m`; a dash for NaN."""
    if not math.isfinite(metres):
        return "–"
    told = said(metres, "height", 2 if metres < 0.995 else 1 if metres < 99.5 else 0)
    return f"{told.text} {told.unit}"


def side_text(angle: float) -> str:
    """A direction in `base_link` [rad, positive left] in words: `ahead`, `35° left`, `behind`; empty for NaN."""
    if not math.isfinite(angle):
        return ""
    angle = math.remainder(angle, math.tau)
    if abs(angle) < STRAIGHT:
        return tr("ahead")
    if abs(angle) > math.pi - STRAIGHT:
        return tr("behind")
    return f"{math.degrees(abs(angle)):.0f}° {tr('left') if angle > 0 else tr('right')}"


def ago_text(seconds: float) -> str:
    """How long ago: `now`, `12 s ago`, `3 min ago`, `2 h ago`; empty for NaN."""
    if not math.isfinite(seconds):
        return ""
    if seconds < 1.5:
        return tr("now")
    if seconds < 59.5:
        return tr("{seconds:.0f} s ago").format(seconds=seconds)
    return (
        tr("{seconds:.0f} min ago").format(seconds=seconds / 60)
        if seconds < 3570
        else tr("{hours:.0f} h ago").format(hours=seconds / 3600)
    )


def wheel_name(joint: str) -> str:
    """What people call a joint: `left` for `wheel_left_joint`, the whole name where nothing would be left."""
    words = [word for word in joint.lower().split("_") if word not in ("wheel", "joint", "link", "drive")]
    return " ".join(tr(SIDES[word]) if word in SIDES else word for word in words) or joint
