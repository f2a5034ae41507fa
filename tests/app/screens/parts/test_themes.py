"""The theme is remembered, but for one that was asked for on the command line."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from app.core.settings_store import Settings
from app.screens.parts.themes import THEMES, Themes
from widgets.core.theme import theme


@pytest.fixture
def settings(tmp_path: Path) -> Iterator[Settings]:
    settings, before = Settings(tmp_path), theme.name
    yield settings
    settings.close()
    theme.name = before


def test_every_theme_is_reached_and_the_last_one_leads_to_the_first(settings: Settings) -> None:
    themes, seen = Themes(settings), []
    for _ in THEMES:
        seen.append(theme.name)
        themes.choose_next()
    assert (seen, theme.name) == (["dark", "sunlight", "night"], "dark")


def test_a_choice_is_there_on_another_day_and_an_override_is_not(settings: Settings) -> None:
    Themes(settings).choose_next()
    Themes(settings, "night")
    assert theme.name == "night"
    Themes(settings)
    assert theme.name == "sunlight"


def test_a_theme_that_there_is_not_is_the_dark_one(settings: Settings) -> None:
    settings.set("theme", "pink")
    Themes(settings)
    assert theme.name == "dark"
