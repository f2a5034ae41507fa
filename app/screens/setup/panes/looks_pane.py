"""Colours of the glass and how large what is touched is."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.screens.parts.themes import TITLES
from app.screens.setup.panes.settings_pane import Choices, SettingsPane, switch_row
from widgets.core.language import mark, tr
from widgets.core.theme import theme

__all__ = ["LooksPane"]

ABOUT = {
    "dark": mark("Indoors and in the evening."),
    "sunlight": mark("White ground and black ink, for the sun on the glass."),
    "night": mark("Dim and red for eyes that are used to the dark; the video too."),
}


class LooksPane(SettingsPane):
    """Theme and gloves."""

    def fill(self) -> Iterable[Widget]:
        """The three themes, and a switch for gloves."""
        self.choices = Choices({name: (tr(TITLES[name]), tr(ABOUT[name])) for name in TITLES}, theme.name)
        self.choices.bind(on_choose=lambda _, name: self.app.themes.choose(name))
        self.gloves = switch_row(
            "front_hand",
            tr("Gloves"),
            tr("Whatever is touched is at least 20 mm wide and high."),
            on=theme.gloves,
            take=lambda on: self.app.preferences.choose("gloves", on),
        )
        yield self.choices
        yield self.heading(tr("Touch"))
        yield self.gloves

    def tick(self) -> None:
        """Another button may have chosen a theme."""
        if self.choices.value != theme.name:
            self.choices.show(theme.name)
        self.gloves.switch.active = theme.gloves
