"""A finger at the edge of the program: events put into SDL's own queue, as the window system does.

On a desktop Kivy listens to the mouse only; its events go the way that those of a touch screen go on a phone:
polled by the window, queued, and dispatched by an input provider in the next frame.
"""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import ClassVar

__all__ = ["Finger"]

MOTION, DOWN, UP = 0x400, 0x401, 0x402
"""SDL_MOUSEMOTION, SDL_MOUSEBUTTONDOWN, SDL_MOUSEBUTTONUP."""
LEFT = 1
WINDOW = 1


class _Motion(ctypes.Structure):
    _fields_: ClassVar = [
        *((name, ctypes.c_uint32) for name in ("type", "timestamp", "window", "which", "state")),
        *((name, ctypes.c_int32) for name in ("x", "y", "xrel", "yrel")),
    ]


class _Button(ctypes.Structure):
    _fields_: ClassVar = [
        *((name, ctypes.c_uint32) for name in ("type", "timestamp", "window", "which")),
        *((name, ctypes.c_uint8) for name in ("button", "state", "clicks", "padding")),
        *((name, ctypes.c_int32) for name in ("x", "y")),
    ]


class _Event(ctypes.Union):
    _fields_: ClassVar = [("motion", _Motion), ("button", _Button), ("room", ctypes.c_uint8 * 128)]


def _library() -> ctypes.CDLL:
    """The SDL that Kivy has loaded, not another one of the system."""
    maps = Path("/proc/self/maps").read_text().splitlines()
    paths = {line.split()[-1] for line in maps if "libSDL2-" in line}
    if not paths:
        raise RuntimeError("Kivy has not loaded SDL: make its window first.")
    return ctypes.CDLL(min(paths))


class Finger:
    """May be moved from any thread. Places are [px] from the window's top left corner."""

    def __init__(self) -> None:
        """RuntimeError before Kivy's window is there."""
        self._sdl = _library()

    def down(self, x: int, y: int) -> None:
        """Touch the screen."""
        self._push(_Event(button=_Button(DOWN, 0, WINDOW, 0, LEFT, 1, 1, 0, x, y)))

    def move(self, x: int, y: int) -> None:
        """Slide to another place."""
        self._push(_Event(motion=_Motion(MOTION, 0, WINDOW, 0, LEFT, x, y, 0, 0)))

    def up(self, x: int, y: int) -> None:
        """Leave it."""
        self._push(_Event(button=_Button(UP, 0, WINDOW, 0, LEFT, 0, 1, 0, x, y)))

    def _push(self, event: _Event) -> None:
        if self._sdl.SDL_PushEvent(ctypes.byref(event)) != 1:
            raise RuntimeError("SDL's queue is full: it is not polled.")
