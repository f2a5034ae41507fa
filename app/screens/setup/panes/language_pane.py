"""The language of the glass, each in its own words."""

from __future__ import annotations

from collections.abc import Iterable

from kivy.uix.widget import Widget

from app.screens.setup.panes.settings_pane import Choices, SettingsPane
from widgets.core.language import LANGUAGES, PSEUDO, language, tr

__all__ = ["LanguagePane"]


class LanguagePane(SettingsPane):
    """Every language but the one for the makers of the app."""

    def fill(self) -> Iterable[Widget]:
        """The choice."""
        offered = {
            name: tongue for name, tongue in LANGUAGES.items() if name != PSEUDO or name == language.name
        }
        self.choices = Choices(
            {name: (tongue.own_name, "") for name, tongue in offered.items()}, language.name
        )
        self.choices.bind(on_choose=lambda _, name: self.app.preferences.choose("language", name))
        yield self.choices
        yield self.remark(tr("What a robot says of itself, as names of places, stays in its own words."))
