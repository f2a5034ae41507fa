"""The panes of the setup screen: a finger chooses, the glass follows, and it is remembered."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from app.screens.parts.lone_page import LonePage
from app.screens.setup.pane_table import PANES, panes
from app.screens.setup.panes.inputs_pane import InputsPane
from app.screens.setup.panes.language_pane import LanguagePane
from app.screens.setup.panes.looks_pane import LooksPane
from app.screens.setup.panes.name_pane import NamePane
from app.screens.setup.panes.settings_pane import SettingsPane
from app.screens.setup.panes.text_pane import TextPane
from app.screens.setup.panes.units_pane import UnitsPane
from app.screens.setup.screen import HANDHELD
from tests.app.glass import Glass
from widgets.core.language import LANGUAGES, PSEUDO, language
from widgets.core.quantities import quantities
from widgets.core.theme import theme

CLASSES: dict[str, type[SettingsPane]] = {
    "name": NamePane,
    "units": UnitsPane,
    "language": LanguagePane,
    "looks": LooksPane,
    "text": TextPane,
    "inputs": InputsPane,
}


@pytest.fixture
def setup(glass: Glass) -> Iterator[Any]:
    """The setup page without a robot."""
    glass.app.show_setup()
    glass.stage.frames(3)
    yield glass.app.pages.lone("setup").screen
    quantities.system, language.name, theme.gloves = "metric", "en", False


def opened(glass: Glass, name: str) -> Any:
    """That pane, open."""
    glass.app.show_setup(name)
    glass.stage.frames(3)
    screen = glass.app.pages.lone("setup").screen
    return screen.pane((HANDHELD, name))


def test_every_pane_of_the_table_opens_with_and_says_how_it_stands(setup: Any, glass: Glass) -> None:
    assert list(panes()) == list(PANES)
    for name in PANES:
        pane = opened(glass, name)
        assert isinstance(pane, CLASSES.get(name, SettingsPane)), name
        assert pane.parent is setup.ids.detail, name
        assert setup.rows[(HANDHELD, name)].chosen
        glass.app.pages.tick_lone()


def test_the_chip_of_the_connect_screen_leads_there_and_back_leaves(glass: Glass) -> None:
    glass.stage.frames(3)
    glass.tap(glass.app.connect.ids.setup)
    glass.stage.frames(3)
    page = glass.app.pages.lone("setup")
    assert isinstance(page, LonePage)
    assert page.parent is glass.app.root
    glass.tap(page.leave_button)
    assert glass.app.connect.parent is glass.app.root


def test_on_a_phone_it_is_a_list_and_then_a_pane_with_a_way_back(glass: Glass) -> None:
    glass.app.root.size = (412, 892)
    glass.app.show_setup()
    glass.stage.frames(5)
    screen = glass.app.pages.lone("setup").screen
    assert (screen.ids.listed.parent, screen.ids.detail.parent) == (screen, None)
    glass.tap(screen.rows[(HANDHELD, "units")])
    glass.stage.frames(3)
    assert (screen.ids.listed.parent, screen.ids.detail.parent) == (None, screen)
    assert screen.back_head.title == "Units"
    assert glass.app.back()
    assert screen.ids.listed.parent is screen
    assert glass.app.back()
    assert glass.app.connect.parent is glass.app.root


@pytest.mark.usefixtures("setup")
def test_units_are_chosen_by_a_finger(glass: Glass) -> None:
    pane = opened(glass, "units")
    glass.tap(pane.choices.rows["nautical"])
    assert (quantities.system, glass.app.settings.get("units")) == ("nautical", "nautical")
    assert opened(glass, "units").choices.rows["nautical"].chosen


@pytest.mark.usefixtures("setup")
def test_every_language_offers_itself_in_its_own_words(glass: Glass) -> None:
    pane = opened(glass, "language")
    words = [row.title for row in pane.choices.rows.values()]
    assert words == [tongue.own_name for name, tongue in LANGUAGES.items() if name != PSEUDO]
    glass.tap(pane.choices.rows["fr"])
    assert (language.name, glass.app.settings.get("language")) == ("fr", "fr")


@pytest.mark.usefixtures("setup")
def test_theme_and_gloves_follow_at_once(glass: Glass) -> None:
    pane = opened(glass, "looks")
    glass.tap(pane.choices.rows["sunlight"])
    assert (theme.name, glass.app.settings.get("theme")) == ("sunlight", "sunlight")
    target = theme.target
    glass.tap(pane.gloves.switch)
    assert theme.gloves
    assert theme.target > target
    assert glass.app.settings.get("gloves") is True
    glass.app.themes.choose("dark")
    glass.app.pages.tick_lone()
    assert pane.choices.rows["dark"].chosen


@pytest.mark.parametrize("name", ["", "  ", "x" * 41, "a\nb"])
def test_a_name_that_nobody_could_read_is_not_taken(setup: Any, glass: Glass, name: str) -> None:
    pane, before = opened(glass, "name"), glass.app.client_name
    pane.field.text = name
    pane.keep()
    assert pane.problem.text
    assert pane.save.disabled
    assert glass.app.client_name == before


@pytest.mark.usefixtures("setup")
def test_a_new_name_is_what_the_next_robot_is_told(glass: Glass) -> None:
    pane = opened(glass, "name")
    pane.field.text = " bridge tablet "
    glass.tap(pane.save)
    assert glass.app.settings.get("client_name") == "bridge tablet"
    network = glass.app._network
    assert {network.connector.client_name, network.pairing.client_name, glass.app.robot_list.client_name} == {
        "bridge tablet"
    }
    assert pane.save.disabled


@pytest.mark.usefixtures("setup")
def test_the_inputs_pane_leads_to_the_inputs_and_the_keys(glass: Glass) -> None:
    pane = opened(glass, "inputs")
    glass.tap(pane.inputs)
    glass.stage.frames(3)
    assert glass.app.pages.lone("inputs").parent is glass.app.root
