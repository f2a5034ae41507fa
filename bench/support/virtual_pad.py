"""A virtual gamepad: SDL's own, plugged into the SDL that Kivy brings."""

from __future__ import annotations

import ctypes
import importlib.util
from pathlib import Path

__all__ = ["EAST", "VirtualPad", "kivys_sdl"]

AHEAD, ASIDE = 1, 0
"""Axes of the left stick."""
RIGHT_AHEAD, RIGHT_ASIDE = 3, 2
"""Of the right one."""
EAST = 1
"""The button on the right of the four."""


def kivys_sdl() -> ctypes.CDLL:
    """The SDL in Kivy's own package, loaded; RuntimeError where Kivy brings none with virtual gamepads."""
    spec = importlib.util.find_spec("kivy")
    site = Path(spec.origin).parent.parent if spec is not None and spec.origin is not None else Path()
    found = sorted(site.glob("[Kk]ivy.libs/libSDL2-2*"))
    library = ctypes.CDLL(str(found[0])) if found else None
    if library is None or not hasattr(library, "SDL_JoystickAttachVirtual"):
        raise RuntimeError(
            f"This Kivy brings no SDL with virtual gamepads; a wheel of Kivy's does. Looked in {site}."
        )
    return library


class VirtualPad:
    """Plugged in from the start; `unplug` is the cable pulled out. A push that SDL does not take is not felt."""

    def __init__(self, sdl: ctypes.CDLL) -> None:
        """`sdl` has its joysticks begun."""
        self._sdl = sdl
        sdl.SDL_JoystickOpen.restype = ctypes.c_void_p
        self._index = sdl.SDL_JoystickAttachVirtual(1, 6, 15, 1)
        if self._index < 0:
            raise RuntimeError("SDL makes no virtual gamepad.")
        self._handle = ctypes.c_void_p(sdl.SDL_JoystickOpen(self._index))

    def push(self, ahead: float, aside: float = 0.0) -> None:
        """Push the left stick ahead and to the left, each -1 to 1."""
        self._move((AHEAD, ahead), (ASIDE, aside))

    def push_right(self, ahead: float, aside: float = 0.0) -> None:
        """The same with the right stick."""
        self._move((RIGHT_AHEAD, ahead), (RIGHT_ASIDE, aside))

    def _move(self, *shares: tuple[int, float]) -> None:
        for axis, share in shares:
            value = ctypes.c_int16(round(-share * 32767))
            self._sdl.SDL_JoystickSetVirtualAxis(self._handle, axis, value)
        self._sdl.SDL_JoystickUpdate()

    def button(self, number: int, *, down: bool) -> None:
        """Press a button or let it go."""
        self._sdl.SDL_JoystickSetVirtualButton(self._handle, number, ctypes.c_uint8(down))
        self._sdl.SDL_JoystickUpdate()

    def unplug(self) -> None:
        """Pull it out."""
        if self._index >= 0:
            self._sdl.SDL_JoystickDetachVirtual(self._index)
            self._sdl.SDL_JoystickClose(self._handle)
            self._index = -1
