"""Pages of zeros go back to the system."""

from __future__ import annotations

import subprocess
import sys

import pytest

# In a process of its own: elsewhere the block may lie where another was when the look began, and then it is left alone.
PROGRAM = """
import ctypes
import mmap
from pathlib import Path
from sim.physics.zero_pages import given_back

SIZE = 64 << 20
PRESENT = 1 << 63

def resident(address):
    with Path("/proc/self/pagemap").open("rb") as pages:
        pages.seek(address // mmap.PAGESIZE * 8)
        entries = memoryview(pages.read(SIZE // mmap.PAGESIZE * 8)).cast("Q")
    return sum(1 for entry in entries if entry & PRESENT) * mmap.PAGESIZE

libc = ctypes.CDLL(None)
libc.malloc.restype = ctypes.c_void_p
with given_back():
    block = libc.malloc(ctypes.c_size_t(SIZE))
    ctypes.memset(block, 0, SIZE)
    ctypes.memset(block + SIZE // 2, 7, 5)
    print(resident(block) / SIZE)
print(resident(block) / SIZE)
print(ctypes.string_at(block + SIZE // 2, 6) == b"\\7" * 5 + b"\\0")
print(any(ctypes.string_at(block, SIZE // 2)))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="Of Linux.")
def test_zeros_go_back_and_everything_else_stays() -> None:
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=True)
    full, left, kept, spoilt = done.stdout.split()
    assert float(full) > 0.9
    assert float(left) < 0.1
    assert (kept, spoilt) == ("True", "False")
