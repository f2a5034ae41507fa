"""Themes that the user can go through, each with what its button shows."""

from __future__ import annotations

from app.core.checked_settings import known
from app.core.settings_store import Settings
from widgets.core.theme import theme

__all__ = ["THEMES", "Themes"]

THEMES = {
    "dark": ("light_mode", "Sunlight", "sunlight"),
    "sunlight": ("bedtime", "Night", "night"),
    "night": ("dark_mode", "Dark", "dark"),
}
"""Name of each to the icon and the text of the button that leads on from it, and to the theme that comes next."""


class Themes:
    """The theme of the glass, remembered in the settings."""

    def __init__(self, settings: Settings, override: str | None = None) -> None:
        """Begin with the remembered theme, or with `override`, which is not remembered."""
        self._settings = settings
        remembered = settings.get("theme")
        theme.name = override or (str(remembered) if known(remembered, THEMES) else "dark")

    def choose_next(self) -> None:
        """Go on to the next theme and remember it."""
        theme.name = THEMES[theme.name][2]
        self._settings.set("theme", theme.name)
