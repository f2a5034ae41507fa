"""The way from the setup screen to the ways in."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.screens.setup.panes.settings_pane import SettingsPane
from widgets.core.language import tr
from widgets.parts.kit import QuietButton

__all__ = ["InputsPane"]


class InputsPane(SettingsPane):
    """Two buttons: where methods are set up, and what keys and buttons do."""

    def fill(self) -> Iterable[Widget]:
        """The buttons."""
        self.inputs = QuietButton(text=tr("Set up the inputs"), icon="tune", size_hint_y=None, height="52dp")
        self.inputs.bind(on_release=lambda _: self.app.show_inputs())
        self.keys = QuietButton(
            text=tr("List of keys and buttons"), icon="keyboard", size_hint_y=None, height="52dp"
        )
        self.keys.bind(on_release=lambda _: self.app.toggle_help())
        yield self.remark(tr("Gamepad, keyboard, voice with talk-back, tilt, shaking and switches."))
        yield self.inputs
        yield self.keys
