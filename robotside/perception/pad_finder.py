"""The landing pad in a picture that was taken straight down, by the tag that lies in its middle.

Pure. The tag's own size is the scale, so that nothing need be known of the camera but that it looks along the robot's axis.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.perception.tag_reader import TAG_SIZE, ReadTags, TagReader

__all__ = ["DOWN", "NOTHING_BELOW", "GroundView", "PadFinder"]

DOWN = "down"
"""Name of the camera that looks straight down."""


@dataclass(frozen=True, slots=True)
class GroundView:
    """One picture of what is below, and how the robot hung in the air then."""

    picture: bytes = b""
    """A JPEG file whose upper edge is ahead."""
    stamp: float = -math.inf
    """When it was taken [s]."""
    wheels: Pose2 = ORIGIN
    """Where the robot was, in the frame of the odometry."""
    roll: float = 0.0
    """[rad]"""
    pitch: float = 0.0
    """[rad], positive is nose down."""
    below: float = math.nan
    """To the ground along the robot's axis [m]; no finite number where that was not measured."""


NOTHING_BELOW = GroundView()
"""Before the first picture."""


class PadFinder:
    """Looks for pads in pictures of the ground."""

    def __init__(self) -> None:
        self._reader = TagReader()

    @property
    def able(self) -> bool:
        """The library that reads tags is there."""
        return self._reader.able

    def find(self, view: GroundView) -> Pose2 | None:
        """Where the middle of the pad lies that is nearest to the point straight below: ahead and to the left of that [m], its yaw 0.

        None where none is seen, or the height of the picture is not known: a tilt would then be taken for a way off.
        """
        if not math.isfinite(view.below):
            return None
        read = self._reader.read(view.picture)
        if read is None or not read.tags:
            return None
        pads = [_levelled(tag, read, view) for tag in read.tags]
        return min(pads, key=lambda pad: math.hypot(pad.x, pad.y))


def _levelled(tag: Any, read: ReadTags, view: GroundView) -> Pose2:
    """Where a tag lies, seen from a robot that hangs askew in the air."""
    first, second, third, fourth = ((float(u), float(v)) for u, v in tag.corners)
    a, b = third[0] - first[0], third[1] - first[1]
    c, d = fourth[0] - second[0], fourth[1] - second[1]
    scale = TAG_SIZE / math.sqrt(abs(a * d - b * c) / 2)
    u, v = (float(value) for value in tag.center)
    ahead, left = -(v - read.height / 2) * scale, -(u - read.width / 2) * scale
    lower = left * math.sin(view.roll) - view.below * math.cos(view.roll)
    x = ahead * math.cos(view.pitch) + lower * math.sin(view.pitch)
    y = left * math.cos(view.roll) + view.below * math.sin(view.roll)
    return Pose2(x, y, 0.0)
