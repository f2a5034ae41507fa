"""The app as the log and the study see it."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from app.inputs.base.method_app import AppSettings, MethodApp

__all__ = ["FileSettings", "StudyApp"]


class FileSettings(AppSettings, Protocol):
    """Settings in a file, beside which the log lies."""

    @property
    def path(self) -> Path:
        """The file."""
        ...


class StudyApp(MethodApp, Protocol):
    """A `MethodApp` with several robots."""

    @property
    def settings(self) -> FileSettings:
        """What the handheld remembers."""
        ...

    @property
    def corner(self) -> Any:
        """STOP ALL."""
        ...

    @property
    def fleet(self) -> Any:
        """All robots that are known, for STOP ALL."""
        ...
