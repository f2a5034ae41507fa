"""Base of the input methods that are switched on and off and keep their settings under their own name."""

from __future__ import annotations

from typing import Any

from app.inputs.base.method_app import MethodApp

__all__ = ["ToggleableMethod"]


class ToggleableMethod:
    """Part of a method of `app.inputs.methods`: whoever has it sets `_app` and `_on`, and says in `_kept` what is kept."""

    name: str
    """Of the method, and of its table in the settings."""
    _app: MethodApp
    _on: bool

    def _kept(self) -> dict[str, Any]:
        """Everything that is kept, as JSON, `on` included."""
        raise NotImplementedError

    def _keep(self) -> None:
        self._app.settings.set(self.name, self._kept())

    @property
    def set_to(self) -> dict[str, Any]:
        """Everything that it goes by, as JSON."""
        return self._kept()

    @property
    def on(self) -> bool:
        """The operator wants it."""
        return self._on

    @on.setter
    def on(self, on: bool) -> None:
        self._on = on
        self._keep()
