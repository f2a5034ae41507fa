"""Reading of the visible tags of docks in a picture: AprilTags of the family 36h11, as corners in pixels.

Where the library that reads tags is not installed there are none.
"""

from __future__ import annotations

import io
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

__all__ = ["MAX_TAG", "TAG_SIZE", "ReadTags", "TagReader", "detector"]

TAG_SIZE = 0.16
"""Edge of a tag's black square [m]."""

MAX_TAG = 29
"""Docks have tags of the numbers 0 to this."""

MAX_ERRORS = 1
"""A tag with more bits misread is none."""

MIN_MARGIN = 20.0
"""Least difference between its black and its white, as the library measures it."""


class ReadTags(NamedTuple):
    """What one picture shows."""

    width: int
    """Of the picture [px]."""
    height: int
    tags: list[Any]
    """The library's detections of docks' tags."""


class TagReader:
    """Reads pictures; the library is loaded with the first."""

    @cached_property
    def _detector(self) -> Any:
        return detector()

    @property
    def able(self) -> bool:
        """The library that reads tags is there."""
        return self._detector is not None

    def read(self, picture: bytes, slope: float | None = None) -> ReadTags | None:
        """The tags of docks in a JPEG file; None where it cannot be read.

        `slope`, the tangent of half the camera's horizontal field of view, gives each tag its place before the camera too.
        """
        if not self.able:
            return None
        grey = _grey(picture)
        if grey is None:
            return None
        height, width = grey.shape
        placed = {}
        if slope is not None:
            focal = width / 2 / slope
            camera = (focal, focal, width / 2, height / 2)
            placed = {"estimate_tag_pose": True, "camera_params": camera, "tag_size": TAG_SIZE}
        found = self._detector.detect(grey, **placed)
        good = [
            tag
            for tag in found
            if tag.tag_id <= MAX_TAG and tag.hamming <= MAX_ERRORS and tag.decision_margin >= MIN_MARGIN
        ]
        return ReadTags(width, height, good)


def _grey(picture: bytes) -> NDArray[np.uint8] | None:
    try:
        with Image.open(io.BytesIO(picture)) as opened:
            return np.ascontiguousarray(opened.convert("L"))
    except (UnidentifiedImageError, OSError, ValueError):
        return None


def detector() -> Any:
    """The library's detector of docks' tags; None where it is not installed."""
    try:
        from pupil_apriltags import Detector
    except ImportError:
        return None

    class Orderly(Detector):  # type: ignore[misc]
        """Frees itself before the families that it uses: the other way round, as the library has it, ends the process now and then."""

        tag_detector_ptr: Any

        def __del__(self) -> None:
            if self.tag_detector_ptr is not None:
                self.libc.apriltag_detector_destroy(self.tag_detector_ptr)
                self.tag_detector_ptr = None
                for family in self.tag_families.values():
                    self.libc.tag36h11_destroy(family)

    return Orderly(families="tag36h11", nthreads=1, quad_decimate=1.0)
