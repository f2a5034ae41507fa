"""The app as an input method sees it: the few parts that a method asks for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from app.inputs.base.button_presses import Press, Presses
from app.intents.intents import Intents

__all__ = ["AppSettings", "HoldActions", "InputDevices", "MethodApp", "MethodRegister", "SettingsApp"]


class AppSettings(Protocol):
    """What the handheld remembers, as JSON by names."""

    def get(self, name: str, default: Any = None, /) -> Any:
        """The value kept under `name`; `default` where nothing is."""
        ...

    def set(self, name: str, value: Any, /) -> None:
        """Keep it."""
        ...


class SettingsApp(Protocol):
    """An app with settings."""

    @property
    def settings(self) -> AppSettings:
        """What the handheld remembers."""
        ...


class HoldActions(Protocol):
    """Actions that last while a key or a button is held."""

    @property
    def held(self) -> dict[str, list[Callable[[bool], object]]]:
        """Name of each to those that are told when it begins (True) and ends."""
        ...


class InputDevices(Protocol):
    """Keys and gamepads."""

    is_switch: Callable[[Press], bool]
    """A key or button is one of somebody's switches."""

    @property
    def presses(self) -> Presses:
        """Every key and every button."""
        ...

    @property
    def meanings(self) -> HoldActions:
        """What keys and buttons do."""
        ...

    def rest(self) -> None:
        """Every control lets go."""
        ...


class MethodRegister(Protocol):
    """All input methods."""

    def get(self, name: str, /) -> Any:
        """The method of that name; None where there is none."""
        ...

    def made(self, name: str, /) -> Any:
        """The same, None where nobody needed it yet, so that it is off."""
        ...

    def turn(self, name: str, on: bool) -> None:
        """Switch one on or off, and remember it; nothing for one that there is not."""
        ...

    @property
    def armed(self) -> list[str]:
        """Names of those that are on, and are a way to give commands."""
        ...

    @property
    def hearing(self) -> list[str]:
        """Names of those that a command could come from now."""
        ...


class MethodApp(SettingsApp, Protocol):
    """Screens are Kivy's and a session is known by what is asked of it: both are `Any` here."""

    @property
    def shell(self) -> Any:
        """The frame round a robot's screens; None without a robot."""
        ...

    @property
    def connect(self) -> Any:
        """The screen without a robot."""
        ...

    @property
    def session(self) -> Any:
        """What is known of the connected robot; None without one."""
        ...

    @property
    def intents(self) -> Intents:
        """The one entry for what was understood."""
        ...

    @property
    def methods(self) -> MethodRegister:
        """All input methods."""
        ...

    @property
    def inputs(self) -> InputDevices:
        """Keys and gamepads."""
        ...

    def now(self) -> float:
        """Our clock [s, monotonic]."""
        ...
