"""The cage of a swimmer in a picture that was taken ahead, by the tag over its coil.

Pure. The frame of a cage lies in the middle of its tag, upright, and looks as a robot does that is docked: into the cage.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.perception.tag_finder import DEFAULT_FIELD_OF_VIEW
from robotside.perception.tag_reader import TAG_SIZE, TagReader

__all__ = ["NOTHING_AHEAD", "CageFinder", "CageSighting", "FrontView"]

CORNER_NOISE = 0.3
"""Standard deviation of a corner in the picture [px]."""

MIN_SPREAD, MIN_TURN, MAX_TURN = 0.01, 0.04, 0.5
"""Least deviation of the place [m]; least and greatest of the direction [rad]."""


@dataclass(frozen=True, slots=True)
class FrontView:
    """One picture of what is ahead, and how the robot hung in the water then."""

    picture: bytes = b""
    """A JPEG file."""
    stamp: float = -math.inf
    """When it was taken [s]."""
    wheels: Pose2 = ORIGIN
    """Where the robot was, in the frame of the odometry."""
    roll: float = 0.0
    """[rad]"""
    pitch: float = 0.0
    """[rad], positive is nose down."""
    height: float = math.nan
    """Of `base_link` above the map's origin [m]; NaN where that is not known."""


NOTHING_AHEAD = FrontView()
"""Before the first picture."""


@dataclass(frozen=True, slots=True)
class CageSighting:
    """One look at the cage."""

    pose: Pose2
    """Of the cage in a `base_link` that lies level."""
    up: float
    """The middle of the tag above `base_link` [m]."""
    spread: float
    """Standard deviation of its place along each axis [m]."""
    turn: float
    """Standard deviation of its direction [rad]."""


class CageFinder:
    """Looks for cages in pictures of a camera that looks straight ahead from `ahead` of `base_link` [m]."""

    def __init__(self, field_of_view: float, ahead: float) -> None:
        """`field_of_view` is the horizontal one [rad], NaN for the usual."""
        known = math.isfinite(field_of_view)
        self._slope = math.tan((field_of_view if known else DEFAULT_FIELD_OF_VIEW) / 2)
        self._ahead, self._reader = ahead, TagReader()

    @property
    def able(self) -> bool:
        """The library that reads tags is there."""
        return self._reader.able

    def find(self, view: FrontView) -> list[CageSighting]:
        """All cages in a picture, none where it cannot be read."""
        read = self._reader.read(view.picture, self._slope)
        if read is None:
            return []
        return [self._sighting(tag, read.width / 2 / self._slope, view) for tag in read.tags]

    def _sighting(self, tag: Any, focal: float, view: FrontView) -> CageSighting:
        """Camera frames look along z with x to the right and y down; a tag's z goes into what bears it."""
        right, down, away = (float(value) for value in tag.pose_t[:, 0])
        x, y, up = _levelled((self._ahead + away, -right, -down), view)
        into = tag.pose_R[:, 2]
        ahead, left, _ = _levelled((float(into[2]), -float(into[0]), -float(into[1])), view)
        pixels = focal * TAG_SIZE / max(away, 1e-3)
        along = CORNER_NOISE / pixels * away
        turn = min(MAX_TURN, max(MIN_TURN, 4 * CORNER_NOISE * away / (pixels * TAG_SIZE)))
        return CageSighting(Pose2(x, y, math.atan2(left, ahead)), up, max(MIN_SPREAD, along), turn)


def _levelled(vector: tuple[float, float, float], view: FrontView) -> tuple[float, float, float]:
    """A vector ahead, to the left and up in `base_link`, in one that lies level."""
    x, y, z = vector
    y, z = (
        y * math.cos(view.roll) - z * math.sin(view.roll),
        y * math.sin(view.roll) + z * math.cos(view.roll),
    )
    return (
        x * math.cos(view.pitch) + z * math.sin(view.pitch),
        y,
        z * math.cos(view.pitch) - x * math.sin(view.pitch),
    )
