"""Pages of zeros go back to the system."""

from __future__ import annotations

import ctypes
import re
import sys
from pathlib import Path

import pytest

from sim.physics.zero_pages import given_back

SIZE = 64 << 20


@pytest.mark.skipif(sys.platform != "linux", reason="Of Linux.")
def test_zeros_go_back_and_everything_else_stays() -> None:
    libc = ctypes.CDLL(None)
    libc.malloc.restype = ctypes.c_void_p
    with given_back():
        block = libc.malloc(ctypes.c_size_t(SIZE))
        ctypes.memset(block, 0, SIZE)
        ctypes.memset(block + SIZE // 2, 7, 5)
        full = _resident(block)
    try:
        assert full > SIZE * 0.9
        assert _resident(block) < SIZE * 0.1
        assert ctypes.string_at(block + SIZE // 2, 6) == b"\7" * 5 + b"\0"
        assert not any(ctypes.string_at(block, SIZE // 2))
    finally:
        libc.free(ctypes.c_void_p(block))


def _resident(address: int) -> int:
    """Of the mapping at that address [bytes]."""
    inside = False
    for line in Path("/proc/self/smaps").read_text().splitlines():
        if span := re.match(r"([0-9a-f]+)-([0-9a-f]+) ", line):
            inside = int(span[1], 16) <= address < int(span[2], 16)
        elif inside and line.startswith("Rss:"):
            return int(line.split()[1]) * 1024
    raise LookupError(address)
