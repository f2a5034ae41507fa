"""The library pybullet, without the prints of its C code; only this file imports it."""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Iterator

__all__ = ["p", "quiet"]


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Silence the C code's prints, which go to the file descriptors and not through Python."""
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    saved = [(fd, os.dup(fd)) for fd in (1, 2)]
    sink = os.open(os.devnull, os.O_WRONLY)
    try:
        for fd, _ in saved:
            os.dup2(sink, fd)
        yield
    finally:
        # What C has buffered would otherwise come out after all, once the descriptors are back.
        ctypes.CDLL(None).fflush(None)
        for fd, copy in saved:
            os.dup2(copy, fd)
            os.close(copy)
        os.close(sink)


with quiet():
    import pybullet as p
