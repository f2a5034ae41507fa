"""Themes that the user can go through, each with what its button shows."""

from __future__ import annotations

__all__ = ["THEMES"]

THEMES = {
    "dark": ("light_mode", "Sunlight", "sunlight"),
    "sunlight": ("bedtime", "Night", "night"),
    "night": ("dark_mode", "Dark", "dark"),
}
"""Name of each to the icon and the text of the button that leads on from it, and to the theme that comes next."""
