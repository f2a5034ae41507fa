"""The app as the execution of intents sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from app.session.recordings import Recordings
    from app.session.session import Session

__all__ = ["ExecutorApp", "ScreenApp", "StopInput"]


class StopInput(Protocol):
    """What carries out STOP of a key, a gamepad or a spoken word."""

    def stop(self) -> None:
        """STOP, as a finger on its button would."""
        ...


class ScreenApp(Protocol):
    """The robot and its screens; the frame of the screens is Kivy's and stands above this room, so it is `Any`."""

    @property
    def session(self) -> Session | None:
        """The connection to the robot; None without one."""
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
    def records(self) -> Recordings:
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
