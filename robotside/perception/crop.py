"""The crop of a camera picture: what was seen with a margin round it, as a small JPEG file."""

from __future__ import annotations

import io

from PIL import Image, UnidentifiedImageError

from bridge.core.camera_frames import picture_size
from bridge.core.errors import ProtocolError
from robotside.perception.sighting import Sighting

__all__ = ["MAX_BYTES", "MAX_EDGE", "cropped"]

MAX_EDGE = 192
"""Of a crop's longer side [px]."""
MAX_BYTES = 24_000
"""Of a crop's file."""
MARGIN = 0.25
"""Round what was seen, as a part of its longer side."""
QUALITIES = (80, 60, 35)


def cropped(jpeg: bytes, seen: Sighting) -> bytes:
    """A JPEG file of at most `MAX_BYTES`; empty where the picture cannot be read or shows nothing there."""
    try:
        picture_size(jpeg)
        with Image.open(io.BytesIO(jpeg), formats=("JPEG",)) as image:
            wide, high = image.size
            around = MARGIN * max(seen.width * wide, seen.height * high)
            box = (
                max(0, int(seen.left * wide - around)),
                max(0, int(seen.top * high - around)),
                min(wide, int(seen.right * wide + around) + 1),
                min(high, int(seen.bottom * high + around) + 1),
            )
            if box[2] - box[0] < 2 or box[3] - box[1] < 2:
                return b""
            small = image.convert("RGB").crop(box)
    except (ProtocolError, UnidentifiedImageError, OSError, ValueError):
        return b""
    small.thumbnail((MAX_EDGE, MAX_EDGE))
    for quality in QUALITIES:
        file = io.BytesIO()
        small.save(file, "JPEG", quality=quality)
        if file.tell() <= MAX_BYTES:
            return file.getvalue()
    return b""
