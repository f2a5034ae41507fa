"""A gamepad made of nothing: SDL's own virtual one, plugged into the SDL that Kivy brings."""

from __future__ import annotations

import ctypes
import importlib.util
from pathlib import Path

__all__ = ["VirtualPad", "kivys_sdl"]

AHEAD, ASIDE = 1, 0
"""Axes of the left stick."""
EAST = 1
"""The button on the right of the four."""


def kivys_sdl() -> ctypes.CDLL | None:
    """The SDL in Kivy's own package, loaded; None where Kivy uses the system's."""
    spec = importlib.util.find_spec("kivy")
    if spec is None or spec.origin is None:
        return None
    found = sorted(Path(spec.origin).parent.parent.glob("[Kk]ivy.libs/libSDL2-2*"))
    return ctypes.CDLL(str(found[0])) if found else None


class VirtualPad:
    """Plugged in from the start; `unplug` is the cable pulled out."""

    def __init__(self, sdl: ctypes.CDLL) -> None:
        """`sdl` has its joysticks begun."""
        self._sdl = sdl
        sdl.SDL_JoystickOpen.restype = ctypes.c_void_p
        self._index = sdl.SDL_JoystickAttachVirtual(1, 6, 15, 1)
        assert self._index >= 0
        self._handle = ctypes.c_void_p(sdl.SDL_JoystickOpen(self._index))

    def push(self, ahead: float, aside: float = 0.0) -> None:
        """Push the left stick ahead and to the left, each -1 to 1."""
        for axis, share in ((AHEAD, ahead), (ASIDE, aside)):
            value = ctypes.c_int16(round(-share * 32767))
            assert self._sdl.SDL_JoystickSetVirtualAxis(self._handle, axis, value) == 0
        self._sdl.SDL_JoystickUpdate()

    def button(self, number: int, *, down: bool) -> None:
        """Press a button or let it go."""
        assert self._sdl.SDL_JoystickSetVirtualButton(self._handle, number, ctypes.c_uint8(down)) == 0
        self._sdl.SDL_JoystickUpdate()

    def unplug(self) -> None:
        """Pull it out."""
        if self._index >= 0:
            self._sdl.SDL_JoystickDetachVirtual(self._index)
            self._sdl.SDL_JoystickClose(self._handle)
            self._index = -1
