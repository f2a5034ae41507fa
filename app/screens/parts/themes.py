"""Themes that the user can go through, each with what its button shows."""

from __future__ import annotations

from app.core.checked_settings import CheckedSettings
from app.core.settings_store import Settings
from widgets.core.language import mark, tr
from widgets.core.theme import theme

__all__ = ["THEMES", "TITLES", "Themes"]

THEMES = {
    "dark": ("dark_mode", mark("Dark", "theme"), "sunlight"),
    "sunlight": ("light_mode", mark("Sunlight"), "night"),
    "night": ("bedtime", mark("Night", "theme"), "dark"),
}
"""Name of each to its icon and what it is called, which is what a button that leads on from it shows, and to the next theme."""
TITLES = {name: title for name, (_, title, _) in THEMES.items()}
"""Name of each to what it is called."""


class Themes:
    """The theme of the glass, remembered in the settings."""

    def __init__(self, settings: Settings, override: str | None = None) -> None:
        """Begin with the remembered theme, or with `override`, which is not remembered."""
        self._settings = settings
        kept = CheckedSettings(
            {"theme": settings.get("theme")} if settings.get("theme") else None, tr("the glass")
        )
        remembered = kept.word("theme", THEMES, usual="dark")
        self.sentence = kept.sentence
        """Why the remembered one is no good, as one sentence; empty when all is well."""
        theme.name = override or remembered

    def choose_next(self) -> None:
        """Go on to the next theme and remember it."""
        self.choose(THEMES[theme.name][2])

    def choose(self, name: str) -> None:
        """Take that of `THEMES` and remember it."""
        theme.name = name
        self._settings.set("theme", name)
