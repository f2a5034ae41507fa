"""The dock in a camera's picture, by its visible tag: AprilTag of the family 36h11.

Where the library that reads tags is not installed there are no sightings.
"""

from __future__ import annotations

import math
from typing import Any

from robotside.core.pose2 import Pose2
from robotside.perception.dock_finder import DockSighting, Expected
from robotside.perception.tag_reader import MAX_TAG, TAG_SIZE, TagReader

__all__ = ["MAX_TAG", "TAG_SIZE", "TagFinder"]

DEFAULT_FIELD_OF_VIEW = 1.2
"""Of a camera that does not tell its own [rad]."""

CORNER_NOISE = 0.3
"""Standard deviation of a corner in the picture [px]."""


class TagFinder:
    """Looks for a dock's tag in pictures of a camera that looks straight ahead from `ahead` of `base_link` [m]."""

    def __init__(self, field_of_view: float, ahead: float = 0.1) -> None:
        """`field_of_view` is the horizontal one [rad], NaN for the usual."""
        known = math.isfinite(field_of_view)
        self._slope = math.tan((field_of_view if known else DEFAULT_FIELD_OF_VIEW) / 2)
        self._ahead, self._reader = ahead, TagReader()

    @property
    def able(self) -> bool:
        """The library that reads tags is there."""
        return self._reader.able

    def find(self, picture: bytes, expected: Expected) -> DockSighting | None:
        """The dock nearest to where it is expected; None where no tag of a dock is there, or the picture cannot be read."""
        read = self._reader.read(picture, self._slope)
        if read is None:
            return None
        sightings = [self._sighting(tag, read.width / 2 / self._slope) for tag in read.tags]
        near = [seen for seen in sightings if expected.misses(seen.pose) <= 1.0]
        return min(near, key=lambda seen: expected.misses(seen.pose)) if near else None

    def _sighting(self, tag: Any, focal: float) -> DockSighting:
        """Camera frames look along z with x to the right; a tag's z goes into what bears it."""
        right, _, away = (float(value) for value in tag.pose_t[:, 0])
        into = tag.pose_R[:, 2]
        yaw = math.atan2(-float(into[0]), float(into[2]))
        pixels = focal * TAG_SIZE / max(away, 1e-3)
        along = CORNER_NOISE / pixels * away
        # seen from straight before it a tag hardly tells its direction: it is the small difference of two edges
        turn = min(0.5, max(0.02, 4 * CORNER_NOISE * away / (pixels * TAG_SIZE)))
        return DockSighting(Pose2(self._ahead + away, -right, yaw), max(0.005, along), turn, "tag")
