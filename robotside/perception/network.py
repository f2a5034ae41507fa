"""The detector's network: what its layers are, and their arithmetic on one picture.

Convolutions of 3 x 3 halve the picture six times, until a cell knows of all of it, and bring what the coarse ones know back to cells of
8 pixels. Each of these gives a score for each class and how far the four edges of the thing are from its middle.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

__all__ = ["CELL", "LAYERS", "OUTPUTS", "Layers", "computed", "run", "wired"]

CELL = 8
"""Edge of what one cell stands for [px]."""

Array: TypeAlias = Any
"""Rows, columns and channels; of another library while it is trained, with pictures before them."""
Convolve: TypeAlias = Callable[[str, Array, int], Array]
"""The layer of that name on an array, with a stride."""
Layers: TypeAlias = Mapping[str, tuple[NDArray[np.float32], NDArray[np.float32]]]
"""By name, the weights (kernel row, kernel column, channels in, channels out) and what is added (channels out)."""

LAYERS: dict[str, tuple[int, int, int]] = {
    "stem": (3, 12, 24),
    "fine": (3, 24, 24),
    "to8": (3, 24, 48),
    "mid1": (3, 48, 48),
    "mid2": (3, 48, 48),
    "to16": (3, 48, 64),
    "big1": (3, 64, 64),
    "big2": (3, 64, 64),
    "to32": (3, 64, 96),
    "far1": (3, 96, 96),
    "far2": (3, 96, 96),
    "to64": (3, 96, 96),
    "whole1": (3, 96, 96),
    "whole2": (3, 96, 96),
    "back32": (1, 96, 96),
    "join32": (3, 96, 96),
    "back16": (1, 96, 64),
    "join16": (3, 64, 64),
    "back8": (1, 64, 48),
    "join8": (3, 48, 64),
    "last": (3, 64, 64),
    "head": (1, 64, 8),
}
"""Edge of the kernel, channels in and out of each layer; all but the last are followed by a rectifier."""
OUTPUTS = LAYERS["head"][2]


def wired(picture: Array, convolve: Convolve, twice: Callable[[Array, Array], Array]) -> Array:
    """The layers in their order. `picture` has its pixels two by two in 12 channels; `twice(a, b)` is `a` twice as large, as `b`."""
    fine = convolve("stem", picture, 2)
    fine = fine + convolve("fine", fine, 1)
    mid = convolve("to8", fine, 2)
    mid = mid + convolve("mid1", mid, 1)
    mid = mid + convolve("mid2", mid, 1)
    big = convolve("to16", mid, 2)
    big = big + convolve("big1", big, 1)
    big = big + convolve("big2", big, 1)
    far = convolve("to32", big, 2)
    far = far + convolve("far1", far, 1)
    far = far + convolve("far2", far, 1)
    whole = convolve("to64", far, 2)
    whole = whole + convolve("whole1", whole, 1)
    whole = whole + convolve("whole2", whole, 1)
    far = far + convolve("join32", far + twice(convolve("back32", whole, 1), far), 1)
    big = convolve("join16", big + twice(convolve("back16", far, 1), big), 1)
    mid = convolve("join8", mid + twice(convolve("back8", big, 1), mid), 1)
    mid = mid + convolve("last", mid, 1)
    return convolve("head", mid, 1)


def run(picture: NDArray[np.uint8], layers: Layers) -> NDArray[np.float32]:
    """What each cell of a picture (rows, columns, 3) gives: (rows / 8, columns / 8, outputs)."""

    def convolve(name: str, array: Array, stride: int) -> Array:
        kernel, added = layers[name]
        found = computed(array, kernel, stride) + added
        return found if name == "head" else np.maximum(found, 0.0, out=found)

    def twice(small: Array, large: Array) -> Array:
        doubled = small.repeat(2, axis=0).repeat(2, axis=1)
        return doubled[: large.shape[0], : large.shape[1]]

    return np.asarray(wired(prepared(picture), convolve, twice), dtype=np.float32)


def prepared(picture: NDArray[np.uint8]) -> NDArray[np.float32]:
    """The picture as bright and as rich in contrast as any other, its pixels two by two in 12 channels."""
    plain = picture.astype(np.float32)
    plain -= plain.mean()
    plain /= max(float(plain.std()), 1.0)
    rows, columns = plain.shape[0] // 2, plain.shape[1] // 2
    return np.ascontiguousarray(
        plain.reshape(rows, 2, columns, 2, 3).transpose(0, 2, 1, 3, 4).reshape(rows, columns, 12)
    )


def computed(array: Array, kernel: NDArray[np.float32], stride: int) -> Array:
    """The convolution of `array`, with a border of zeros, as one product of matrices."""
    edge, _, channels, made = kernel.shape
    if edge == 1:
        return array @ kernel[0, 0]
    rows, columns = array.shape[:2]
    framed = np.zeros((rows + 2, columns + 2, channels), dtype=np.float32)
    framed[1:-1, 1:-1] = array
    high, wide = -(-rows // stride), -(-columns // stride)
    down, right, deep = framed.strides
    # three neighbours in a row lie together in memory: they are copied as one
    patches = np.lib.stride_tricks.as_strided(
        framed, (high, wide, 3, 3 * channels), (down * stride, right * stride, down, deep), writeable=False
    )
    return (patches.reshape(high * wide, -1) @ kernel.reshape(-1, made)).reshape(high, wide, made)
