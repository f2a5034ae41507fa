"""The app as the execution of intents sees it."""

from __future__ import annotations

from typing import Any, Protocol

__all__ = ["ExecutorApp", "ScreenApp", "StopInput"]


class StopInput(Protocol):
    """What carries out STOP of a key, a gamepad or a spoken word."""

    def stop(self) -> None:
        """STOP, as a finger on its button would."""
        ...


class ScreenApp(Protocol):
    """A session is known by what is asked of it, and screens are Kivy's: both are `Any` here."""

    @property
    def session(self) -> Any:
        """What is known of the connected robot; None without one."""
        ...

    @property
    def shell(self) -> Any:
        """The frame round a robot's screens; None without a robot."""
        ...


class ExecutorApp(ScreenApp, Protocol):
    """What intents ask for beside the robot."""

    @property
    def inputs(self) -> StopInput:
        """Keys and gamepads, and STOP."""
        ...

    @property
    def corner(self) -> Any:
        """STOP ALL."""
        ...

    @property
    def records(self) -> Any:
        """Recordings and snapshots."""
        ...

    @property
    def themes(self) -> Any:
        """The themes."""
        ...

    @property
    def visit(self) -> Any:
        """The visit to the connected robot."""
        ...

    def back(self) -> bool:
        """As Android's Back."""
        ...

    def show(self, screen: str) -> None:
        """Put a screen of the robot in the window."""
        ...

    def show_inputs(self) -> None:
        """Put the inputs screen in the window."""
        ...
