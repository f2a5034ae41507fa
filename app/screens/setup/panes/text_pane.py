"""How large text is."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.screens.setup.panes.settings_pane import Choices, SettingsPane
from widgets.core.language import tr

__all__ = ["SIZES", "TextPane"]

SIZES = (1.0, 1.25, 1.5, 1.75, 2.0)
"""Offered, in times of the device's own."""


class TextPane(SettingsPane):
    """A choice of sizes; everything on the glass follows with the next frame."""

    def fill(self) -> Iterable[Widget]:
        """The sizes."""
        preferences = self.app.preferences
        self.choices = Choices({size: (f"{size * 100:.0f} %", "") for size in SIZES}, preferences.text)
        self.choices.bind(on_choose=lambda _, size: preferences.choose("text", size))
        yield self.remark(tr("In times of the size that this device is set to."))
        yield self.choices
