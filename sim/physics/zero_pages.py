"""Memory that a library filled with zeros, given back to the system until something is written there.

Bullet's client writes zeros over 20 MB of buffers when it connects, for messages and pictures that never come.
"""

from __future__ import annotations

import ctypes
import mmap
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import numpy as np

__all__ = ["given_back"]

_MAPS = Path("/proc/self/maps")
_MIN_BLOCK = 1 << 20
"""Smaller blocks are left alone [bytes]."""
_DONTNEED = 4
"""As Linux has it: such pages are gone, and zeros when they are read."""


@contextmanager
def given_back() -> Iterator[None]:
    """Give back the pages of zeros in large blocks that are allocated while this is open.

    No other thread may write into them meanwhile. Does nothing where the system is not
    Linux or the C library is not glibc.
    """
    before = _mapped()
    yield
    for start, size in _blocks(before, _mapped()):
        _give_back(start, size)


def _mapped() -> list[tuple[int, int]]:
    """Start and end of each mapping that may be written and has no file or name."""
    if sys.platform != "linux":
        return []
    try:
        lines = [line.split() for line in _MAPS.read_text().splitlines()]
    except OSError:
        return []
    spans = [line[0].partition("-") for line in lines if len(line) == 5 and line[1] == "rw-p"]
    return [(int(start, 16), int(end, 16)) for start, _, end in spans]


def _blocks(before: Sequence[tuple[int, int]], after: Sequence[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    """Address and size of the large blocks that malloc mapped in between.

    Each begins with a page whose first words are zero and its size with the mark 2 (malloc.c, IS_MMAPPED): so nothing else
    that was mapped in between, as Python's own arenas, is taken for one.
    """
    page = mmap.PAGESIZE
    for start, end in after:
        known = [(low, high) for low, high in before if low < end and high > start]
        place = start
        while place < end:
            inside = next((high for low, high in known if low <= place < high), None)
            if inside is not None:
                place = inside
                continue
            zero, marked = (ctypes.c_size_t * 2).from_address(place)
            size = marked - 2
            if zero == 0 and size % page == 0 and _MIN_BLOCK <= size <= end - place:
                yield place, size
                place += size
            else:
                place += page


def _give_back(start: int, size: int) -> None:
    page = mmap.PAGESIZE
    words = np.ctypeslib.as_array((ctypes.c_uint64 * (size // 8)).from_address(start))
    blank = ~words.reshape(-1, page // 8).any(axis=1)
    edges = np.flatnonzero(np.diff(blank, prepend=False, append=False))
    advise = ctypes.CDLL(None).madvise
    for first, last in edges.reshape(-1, 2).tolist():
        advise(
            ctypes.c_void_p(start + first * page),
            ctypes.c_size_t((last - first) * page),
            ctypes.c_int(_DONTNEED),
        )
