"""Pictures as JPEG files."""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

__all__ = ["Picture", "jpeg"]

QUALITY = 80
"""Of the JPEG."""

Picture = NDArray[np.uint8]
"""(height, width, 3) RGB, top row first; a fourth byte a pixel means nothing."""


def jpeg(picture: Picture) -> bytes:
    """The picture as a JPEG file."""
    file = io.BytesIO()
    height, width, depth = picture.shape
    if depth == 4:  # as Pillow keeps it, so that it is not copied
        image = Image.frombuffer("RGBX", (width, height), picture, "raw", "RGBX", 0, 1)
    else:
        image = Image.fromarray(picture)
    image.save(file, "JPEG", quality=QUALITY)
    return file.getvalue()
