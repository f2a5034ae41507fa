"""The app as the scan of its window sees it."""

from __future__ import annotations

from typing import Any, Protocol

from app.inputs.base.method_app import MethodApp

__all__ = ["WindowApp"]


class WindowApp(MethodApp, Protocol):
    """Widgets are Kivy's, hence `Any`."""

    @property
    def root(self) -> Any:
        """The widget that holds everything in the window."""
        ...

    @property
    def corner(self) -> Any:
        """STOP ALL, with the `layer` that holds it."""
        ...

    @property
    def robots(self) -> Any:
        """Every robot that is heard or saved."""
        ...
