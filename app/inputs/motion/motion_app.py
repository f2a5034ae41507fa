"""The app as a method with motion sensors sees it."""

from __future__ import annotations

from typing import Protocol

from app.inputs.base.method_app import MethodApp
from app.inputs.motion.motion_sensing import MotionSensing

__all__ = ["MotionApp"]


class MotionApp(MethodApp, Protocol):
    """A `MethodApp` on a device that can be moved."""

    @property
    def sensing(self) -> MotionSensing:
        """The motion sensors, shared by all methods."""
        ...
