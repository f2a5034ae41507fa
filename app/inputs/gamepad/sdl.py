"""SDL, below Kivy's window, asked for what Kivy does not hand on: lifted fingers, and gamepads.

Kivy opens the gamepads that are there when its window is made, tells of their axes and buttons, and never that one went
or came. It drops the end of a touch that comes while the app is paused. SDL itself knows both.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from app.inputs.gamepad.pad_table import PadTable
from widgets.core.language import tr

__all__ = ["PadState", "Sdl"]

JOYSTICK, CONTROLLER = 0x0200, 0x2000
"""SDL's subsystems."""


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
    triggers: tuple[float, float] = (0.0, 0.0)
    """How far the left and the right trigger are pressed, each 0 to 1."""
    buttons: frozenset[str] = frozenset()
    """Names of the buttons that are down, triggers and the cross among them."""
    names: Mapping[int, str] = field(default_factory=dict)
    """What Kivy's numbers of its buttons are called."""


class _Finger(ctypes.Structure):
    _fields_ = (("id", ctypes.c_int64), ("x", ctypes.c_float), ("y", ctypes.c_float), ("p", ctypes.c_float))


class _Pad:
    """An open gamepad: its handle, its name, and where everything on it is."""

    def __init__(self, handle: int, name: str, table: PadTable, counts: tuple[int, int, int]) -> None:
        self.handle, self.name, self.table = handle, name, table
        self.axes, self.buttons, self.hats = counts


class Sdl:
    """Asked in the UI thread alone, in which Kivy feeds SDL with events."""

    def __init__(self, library: ctypes.CDLL) -> None:
        """`library` is the very SDL that the window stands on; another copy would know nothing. OSError when it is too old."""
        self._sdl = library
        try:
            self._declare()
        except AttributeError as lacking:
            raise OSError(tr("This SDL has no {lacking}.").format(lacking=lacking)) from lacking
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
            ("SDL_JoystickNumHats", number, [pointer]),
            ("SDL_JoystickGetHat", ctypes.c_uint8, [pointer, number]),
            ("SDL_JoystickGetAxis", ctypes.c_int16, [pointer, number]),
            ("SDL_JoystickGetButton", ctypes.c_uint8, [pointer, number]),
            ("SDL_JoystickGetDeviceInstanceID", ctypes.c_int32, [number]),
            ("SDL_GameControllerMappingForDeviceIndex", pointer, [number]),
            ("SDL_free", None, [pointer]),
            ("SDL_GetTouchDevice", ctypes.c_int64, [number]),
            ("SDL_GetNumTouchFingers", number, [ctypes.c_int64]),
            ("SDL_GetTouchFinger", ctypes.POINTER(_Finger), [ctypes.c_int64, number]),
            ("SDL_GetMouseState", ctypes.c_uint32, [pointer, pointer]),
            ("SDL_GetKeyboardState", ctypes.POINTER(ctypes.c_uint8), [ctypes.POINTER(number)]),
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

    # keys

    def key(self, scancode: int) -> bool:
        """The key at that place of the keyboard is down, as far as SDL knows."""
        count = ctypes.c_int()
        keys = self._sdl.SDL_GetKeyboardState(ctypes.byref(count))
        return 0 <= scancode < count.value and bool(keys[scancode])

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
        count = (sdl.SDL_JoystickNumAxes, sdl.SDL_JoystickNumButtons, sdl.SDL_JoystickNumHats)
        counts = count[0](handle), count[1](handle), count[2](handle)
        if counts[0] < 2 or counts[1] < 1:  # a sensor, a pedal: no gamepad
            sdl.SDL_JoystickClose(handle)
            return None
        name = (sdl.SDL_JoystickName(handle) or b"").decode(errors="replace")
        return _Pad(handle, name or "Gamepad", PadTable(self._mapping(index)), counts)

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
        hats = [sdl.SDL_JoystickGetHat(handle, hat) for hat in range(pad.hats)]
        table, east = pad.table, pad.table.east
        return PadState(
            number,
            pad.name,
            # SDL's axes point right and down
            -table.share("lefty", axes),
            -table.share("leftx", axes),
            stop=east < len(buttons) and bool(buttons[east]),
            stop_button=east,
            raw=(*axes, *buttons, *hats),
            right=(-table.share("righty", axes), -table.share("rightx", axes)),
            triggers=table.triggers(axes, buttons),
            buttons=table.down(axes, buttons, hats),
            names=table.names,
        )
