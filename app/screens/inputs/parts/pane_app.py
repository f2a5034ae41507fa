"""The app as the panes of the inputs screen see it."""

from __future__ import annotations

from typing import Any, Protocol

from app.inputs.inputs import Inputs
from app.inputs.methods import Methods
from app.inputs.motion.motion_sensing import MotionSensing
from app.intents.intents import Intents

__all__ = ["PaneApp"]


class PaneApp(Protocol):
    """Input methods, keys and gamepads, and what each may do."""

    @property
    def methods(self) -> Methods:
        """All input methods."""
        ...

    @property
    def inputs(self) -> Inputs:
        """Keys and gamepads."""
        ...

    @property
    def intents(self) -> Intents:
        """The one entry for what was understood."""
        ...

    @property
    def sensing(self) -> MotionSensing:
        """The motion sensors."""
        ...

    @property
    def session(self) -> Any:
        """What is known of the connected robot; None without one."""
        ...

    def now(self) -> float:
        """Our clock [s, monotonic]."""
        ...
