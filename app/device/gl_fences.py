"""Fences of OpenGL: whether everything that was drawn before one is on the glass yet, asked without waiting for it."""

from __future__ import annotations

import ctypes
import re
from collections.abc import Callable
from typing import Any

__all__ = ["GlFences"]

VERSION = 0x1F02
"""GL_VERSION"""
COMMANDS_COMPLETE = 0x9117
"""GL_SYNC_GPU_COMMANDS_COMPLETE"""
FLUSH = 1
"""GL_SYNC_FLUSH_COMMANDS_BIT: begin with what is only queued."""
TIMEOUT_EXPIRED = 0x911B
"""GL_TIMEOUT_EXPIRED: not yet. Every other answer means that there is nothing to wait for."""
SINCE_GL, SINCE_ES = (3, 2), (3, 0)
"""Versions of OpenGL and of OpenGL ES that have fences."""


class GlFences:
    """Used in the thread that draws, while its window is there."""

    def __init__(self, function: Callable[[bytes], int | None]) -> None:
        """`function` gives the address of a function of OpenGL by its name. OSError where this OpenGL has no fences."""
        text = _callable(function, b"glGetString", ctypes.c_char_p, ctypes.c_uint)(VERSION)
        if not has_fences((text or b"").decode(errors="replace")):
            raise OSError(f"OpenGL {text!r} has no fences.")
        self._insert = _callable(function, b"glFenceSync", ctypes.c_void_p, ctypes.c_uint, ctypes.c_uint)
        self._wait = _callable(
            function, b"glClientWaitSync", ctypes.c_uint, ctypes.c_void_p, ctypes.c_uint, ctypes.c_uint64
        )
        self._delete = _callable(function, b"glDeleteSync", None, ctypes.c_void_p)

    @classmethod
    def of(cls, library: ctypes.CDLL | None) -> GlFences | None:
        """Those of the window that stands on this SDL; None where there are none."""
        if library is None:
            return None
        address = library.SDL_GL_GetProcAddress
        address.restype, address.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
        try:
            return cls(address)
        except OSError:
            return None

    def insert(self) -> int | None:
        """A fence behind everything that was drawn so far, which begins to be drawn now; None where there was no room for one."""
        fence: int | None = self._insert(COMMANDS_COMPLETE, 0)
        if fence:
            self._wait(fence, FLUSH, 0)
        return fence

    def passed(self, fence: int) -> bool:
        """Everything before it is drawn. Waits for nothing."""
        return bool(self._wait(fence, 0, 0) != TIMEOUT_EXPIRED)

    def delete(self, fence: int) -> None:
        """It is not asked for any more."""
        self._delete(fence)


def has_fences(version: str) -> bool:
    """An OpenGL that calls itself so has them, as in `4.5 (Compatibility Profile) Mesa` or `OpenGL ES 3.2 v1`."""
    found = re.search(r"(OpenGL ES )?(\d+)\.(\d+)", version)
    if found is None:
        return False
    return (int(found[2]), int(found[3])) >= (SINCE_ES if found[1] else SINCE_GL)


def _callable(function: Callable[[bytes], int | None], name: bytes, result: Any, *takes: Any) -> Any:
    address = function(name)
    if not address:
        raise OSError(f"This OpenGL has no {name.decode()}.")
    return ctypes.CFUNCTYPE(result, *takes)(address)
