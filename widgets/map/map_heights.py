"""Heights and depths on a map: beside the robot, at points, and between which floor and ceiling the robot stays.

One judge tells what is said of a height, for all that shows one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from kivy.metrics import dp, sp

from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from widgets.core.canvas_ink import Word, ground, tint
from widgets.core.geometry import View
from widgets.core.language import tr
from widgets.core.quantities import said
from widgets.core.shapes import Shapes
from widgets.core.theme import theme

__all__ = ["between_words", "height_marks", "height_words", "pose_words", "robot_height"]

LEAST = 0.15
"""Nearer to the ground or the surface than this nothing is said [m]: waves and legs lift a robot as far."""
MAX_SPREAD = 1.0
"""A height that may be off by more than this, one standard deviation, is not known [m]."""
HEIGHT_VARIANCE = 14
"""Its place in a covariance of six rows."""


def height_words(height: float) -> str:
    """Of a height above the map's origin [m], as in `2.0 m up` and `1.5 m deep`; empty at the ground, and for NaN."""
    if not math.isfinite(height) or abs(height) < LEAST:
        return ""
    words = said(abs(height), "height", 1).words
    return (tr("{height} up") if height > 0 else tr("{depth} deep")).format(height=words, depth=words)


def pose_words(msg: PoseWithCovarianceStamped) -> str:
    """The same of a pose; empty where it is not known well enough."""
    told = msg.pose.covariance
    known = len(told) == 36 and not told[HEIGHT_VARIANCE] > MAX_SPREAD**2
    return height_words(msg.pose.pose.position.z) if known else ""


def between_words(low: float, high: float) -> str:
    """Of a floor and a ceiling [m], infinite for none; empty for neither."""
    if low == -math.inf and high == math.inf:
        return ""
    deep = (high if high < math.inf else low) <= 0.0
    low, high = (-high, -low) if deep else (low, high)
    least, most = said(low, "height", 1).words, said(high, "height", 1).words
    if math.isinf(high):
        words = tr("Depth from {least}") if deep else tr("Height from {least}")
    elif math.isinf(low):
        words = tr("Depth up to {most}") if deep else tr("Height up to {most}")
    else:
        words = tr("Depth {least} to {most}") if deep else tr("Height {least} to {most}")
    return words.format(least=least, most=most)


def height_marks(
    shapes: Shapes,
    view: View,
    waypoints: Sequence[Sequence[float]],
    heights: Sequence[float | None],
    radius: float,
) -> Iterator[Word]:
    """The height of each point that has one, under its disc; `heights` may be shorter than `waypoints`, None for none."""
    for place, height in zip(waypoints, heights, strict=False):
        words = height_words(height) if height is not None else ""
        if words:
            x, y = view.to_screen(*place[:2])
            word = Word(words, x, y - radius - dp(11), sp(13), theme.plan, True)
            ground(shapes, word, tint(theme.bg, 0.85))
            yield word


def robot_height(
    shapes: Shapes, at: tuple[float, float], words: str, radius: float, *, faded: bool
) -> Iterator[Word]:
    """How high or deep the robot is, under its sign `at` [px]; nothing for no `words`."""
    if words:
        colour = theme.muted if faded else theme.text
        word = Word(words, at[0], at[1] - radius - dp(13), sp(14), colour, True)
        ground(shapes, word, tint(theme.bg, 0.85))
        yield word
