"""Smaller and smaller copies of a picture, for textures that are seen from afar.

OpenGL can make them itself, but Mesa's software renderer compiles programs for it first, half a second for a world.
"""

from __future__ import annotations

import ctypes
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

__all__ = ["add_mipmaps", "halved"]

_TEXTURE_2D, _BYTES, _ALIGNMENT = 0x0DE1, 0x1401, 0x0CF5
_FORMATS = {2: (0x822B, 0x8227), 4: (0x8058, 0x1908)}
"""By the bytes a pixel: how the texture keeps them, and what they are."""

Picture = NDArray[np.uint8]


def halved(picture: Picture) -> Picture:
    """Half as broad and high, at least one pixel: the mean of each four; an odd last row or column is left out."""
    high, wide = max(picture.shape[0] // 2, 1), max(picture.shape[1] // 2, 1)
    even = picture[: 2 * high, : 2 * wide].astype(np.uint16)
    if even.shape[0] == 1:
        even = np.repeat(even, 2, axis=0)
    if even.shape[1] == 1:
        even = np.repeat(even, 2, axis=1)
    rows = even[0::2] + even[1::2]
    return ((rows[:, 0::2] + rows[:, 1::2] + 2) // 4).astype(np.uint8)


def add_mipmaps(texture: moderngl.Texture, data: bytes, unit: int) -> None:
    """Give `texture`, which has this `data`, all its smaller copies; it is left bound to `unit`."""
    calls = _calls()
    if calls is None:
        texture.build_mipmaps()
        texture.use(unit)
        return
    make, store = calls
    kept, told = _FORMATS[texture.components]
    width, height = texture.size
    picture = np.frombuffer(data, dtype=np.uint8).reshape(height, width, texture.components)
    texture.use(unit)
    store(_ALIGNMENT, 1)
    level = 0
    while max(picture.shape[:2]) > 1:
        picture, level = halved(picture), level + 1
        high, wide = picture.shape[:2]
        make(_TEXTURE_2D, level, kept, wide, high, 0, told, _BYTES, picture.tobytes())


def _calls() -> tuple[Any, Any] | None:
    """OpenGL's own `glTexImage2D` and `glPixelStorei`, which moderngl does not offer; None where they are not found."""
    try:
        find = ctypes.CDLL("libEGL.so.1").eglGetProcAddress
    except (OSError, AttributeError):
        return None
    find.restype, find.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    make, store = find(b"glTexImage2D"), find(b"glPixelStorei")
    if not (make and store):
        return None
    number = ctypes.c_int
    making = ctypes.CFUNCTYPE(
        None, ctypes.c_uint, *(number,) * 5, ctypes.c_uint, ctypes.c_uint, ctypes.c_char_p
    )
    return making(make), ctypes.CFUNCTYPE(None, ctypes.c_uint, number)(store)
