"""What SDL, on which Kivy's window stands, knows and Kivy does not hand on: fingers that are gone, and gamepads.

Kivy opens the gamepads that are there when its window is made, tells of their axes and buttons, and never that one went
or came. It drops the end of a touch that comes while the app is paused. SDL itself knows both.
"""

from __future__ import annotations

import ctypes
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

__all__ = ["PadState", "Sdl"]

JOYSTICK, CONTROLLER = 0x0200, 0x2000
"""SDL's subsystems."""
RANGE = 32768.0
"""Of an axis on either side of its middle."""
PART = re.compile(r"(\w+):([-+]?)(a|b)(\d+)(~?)")
"""One entry of SDL's table of gamepads, as in `leftx:a0`, `lefty:a1~`, `b:b1`."""
LEFT_X, LEFT_Y, RIGHT_X, RIGHT_Y, EAST = 0, 1, 2, 3, 1
"""Axes of both sticks and the button on the right of the four where SDL's table does not know the gamepad."""


@dataclass(frozen=True, slots=True)
class PadState:
    """A gamepad as it is now."""

    number: int
    """SDL's own for this plugging in; never used twice."""
    name: str
    forward: float
    """How far the left stick is pushed away from the operator, -1 to 1."""
    left: float
    """How far it is pushed to the left, -1 to 1."""
    stop: bool
    """The button on the right of the four (B, circle) is down."""
    stop_button: int
    """Its number in Kivy's events."""
    raw: tuple[int, ...]
    """Everything that it measures: a gamepad whose `raw` changes is alive."""
    right: tuple[float, float] = (0.0, 0.0)
    """How far the right stick is pushed away from the operator and to the left, each -1 to 1."""


class _Finger(ctypes.Structure):
    _fields_ = (("id", ctypes.c_int64), ("x", ctypes.c_float), ("y", ctypes.c_float), ("p", ctypes.c_float))


class _Pad:
    """An open gamepad: its handle, its name, and where its stick and its button are."""

    def __init__(self, handle: int, name: str, mapping: str, counts: tuple[int, int]) -> None:
        self.handle, self.name, self.axes, self.buttons = handle, name, *counts
        entries = {key: (sign + tilde, int(number)) for key, sign, _, number, tilde in PART.findall(mapping)}
        self.x = entries.get("leftx", ("", LEFT_X))
        self.y = entries.get("lefty", ("", LEFT_Y))
        self.right_x = entries.get("rightx", ("", RIGHT_X))
        self.right_y = entries.get("righty", ("", RIGHT_Y))
        self.stop_button = entries.get("b", ("", EAST))[1]

    def share(self, axis: tuple[str, int], raw: Sequence[int]) -> float:
        """An axis from -1 to 1, turned round where the table says so."""
        way, index = axis
        value = raw[index] / RANGE if index < self.axes else 0.0
        return -value if way in ("-", "~") else value


class Sdl:
    """Asked in the UI thread alone, in which Kivy feeds SDL with events."""

    def __init__(self, library: ctypes.CDLL) -> None:
        """`library` is the very SDL that the window stands on; another copy would know nothing. OSError when it is too old."""
        self._sdl = library
        try:
            self._declare()
        except AttributeError as lacking:
            raise OSError(f"This SDL has no {lacking}.") from lacking
        self._pads: dict[int, _Pad] = {}
        library.SDL_InitSubSystem(JOYSTICK)
        library.SDL_InitSubSystem(CONTROLLER)  # reads the table of gamepads

    def _declare(self) -> None:
        """The functions that take or return anything but an int."""
        pointer, number = ctypes.c_void_p, ctypes.c_int
        for name, result, takes in (
            ("SDL_JoystickOpen", pointer, [number]),
            ("SDL_JoystickClose", None, [pointer]),
            ("SDL_JoystickName", ctypes.c_char_p, [pointer]),
            ("SDL_JoystickGetAttached", number, [pointer]),
            ("SDL_JoystickNumAxes", number, [pointer]),
            ("SDL_JoystickNumButtons", number, [pointer]),
            ("SDL_JoystickGetAxis", ctypes.c_int16, [pointer, number]),
            ("SDL_JoystickGetButton", ctypes.c_uint8, [pointer, number]),
            ("SDL_JoystickGetDeviceInstanceID", ctypes.c_int32, [number]),
            ("SDL_GameControllerMappingForDeviceIndex", pointer, [number]),
            ("SDL_free", None, [pointer]),
            ("SDL_GetTouchDevice", ctypes.c_int64, [number]),
            ("SDL_GetNumTouchFingers", number, [ctypes.c_int64]),
            ("SDL_GetTouchFinger", ctypes.POINTER(_Finger), [ctypes.c_int64, number]),
            ("SDL_GetMouseState", ctypes.c_uint32, [pointer, pointer]),
        ):
            function = getattr(self._sdl, name)
            function.restype, function.argtypes = result, takes

    # fingers

    def lifted(self, device: str, finger: Any) -> bool:
        """A touch of Kivy's is known to be over: `device` and `finger` are what Kivy calls the device and the finger."""
        if device == "mouse":
            return not self._sdl.SDL_GetMouseState(None, None)
        return device == "sdl" and finger not in self._fingers()

    def _fingers(self) -> set[int]:
        found = set()
        for index in range(self._sdl.SDL_GetNumTouchDevices()):
            device = self._sdl.SDL_GetTouchDevice(index)
            for number in range(max(0, self._sdl.SDL_GetNumTouchFingers(device))):
                finger = self._sdl.SDL_GetTouchFinger(device, number)
                if finger:
                    found.add(int(finger.contents.id))
        return found

    # gamepads

    def pads(self) -> list[PadState]:
        """Every gamepad that is plugged in now; one that has just come is opened, one that went is closed."""
        sdl, there = self._sdl, {}
        for index in range(sdl.SDL_NumJoysticks()):
            number = sdl.SDL_JoystickGetDeviceInstanceID(index)
            pad = self._pads.get(number) or self._open(index)
            if pad is not None and sdl.SDL_JoystickGetAttached(pad.handle):
                there[number] = pad
        for number in self._pads.keys() - there.keys():
            sdl.SDL_JoystickClose(self._pads[number].handle)
        self._pads = there
        return [self._state(number, pad) for number, pad in there.items()]

    def close(self) -> None:
        """Let go of every gamepad."""
        for pad in self._pads.values():
            self._sdl.SDL_JoystickClose(pad.handle)
        self._pads = {}
        for system in (CONTROLLER, JOYSTICK):
            self._sdl.SDL_QuitSubSystem(system)

    def _open(self, index: int) -> _Pad | None:
        sdl = self._sdl
        handle = sdl.SDL_JoystickOpen(index)
        if not handle:
            return None
        counts = sdl.SDL_JoystickNumAxes(handle), sdl.SDL_JoystickNumButtons(handle)
        if counts[0] < 2 or counts[1] < 1:  # a sensor, a pedal: no gamepad
            sdl.SDL_JoystickClose(handle)
            return None
        name = (sdl.SDL_JoystickName(handle) or b"").decode(errors="replace")
        return _Pad(handle, name or "Gamepad", self._mapping(index), counts)

    def _mapping(self, index: int) -> str:
        text = self._sdl.SDL_GameControllerMappingForDeviceIndex(index)
        if not text:
            return ""
        try:
            return ctypes.string_at(text).decode(errors="replace")
        finally:
            self._sdl.SDL_free(text)

    def _state(self, number: int, pad: _Pad) -> PadState:
        sdl, handle = self._sdl, pad.handle
        axes = [sdl.SDL_JoystickGetAxis(handle, axis) for axis in range(pad.axes)]
        buttons = [sdl.SDL_JoystickGetButton(handle, button) for button in range(pad.buttons)]
        stop = pad.stop_button < len(buttons) and bool(buttons[pad.stop_button])
        # SDL's axes point right and down
        forward, left = -pad.share(pad.y, axes), -pad.share(pad.x, axes)
        right = -pad.share(pad.right_y, axes), -pad.share(pad.right_x, axes)
        return PadState(number, pad.name, forward, left, stop, pad.stop_button, (*axes, *buttons), right)
