"""The panes of the setup screen: a finger chooses, the glass follows, and it is remembered."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from kivy.metrics import Metrics, sp

from app.screens.parts.lone_page import LonePage
from app.screens.setup.pane_table import PANES, panes
from app.screens.setup.panes.about_pane import AboutPane, app_version
from app.screens.setup.panes.hand_pane import HandPane
from app.screens.setup.panes.inputs_pane import InputsPane
from app.screens.setup.panes.language_pane import LanguagePane
from app.screens.setup.panes.looks_pane import LooksPane
from app.screens.setup.panes.name_pane import NamePane
from app.screens.setup.panes.settings_pane import SettingsPane
from app.screens.setup.panes.sounds_pane import SoundsPane
from app.screens.setup.panes.storage_pane import StoragePane, size_words
from app.screens.setup.panes.text_pane import TextPane
from app.screens.setup.panes.units_pane import UnitsPane
from app.screens.setup.screen import HANDHELD
from tests.app.glass import Glass
from widgets.core.language import LANGUAGES, PSEUDO, language
from widgets.core.quantities import quantities
from widgets.core.theme import theme
from widgets.parts.kit import IconButton

CLASSES: dict[str, type[SettingsPane]] = {
    "name": NamePane,
    "units": UnitsPane,
    "language": LanguagePane,
    "looks": LooksPane,
    "hand": HandPane,
    "text": TextPane,
    "sounds": SoundsPane,
    "inputs": InputsPane,
    "storage": StoragePane,
    "about": AboutPane,
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


def kept(glass: Glass, name: str, size: int, *, folder: int = 0) -> Path:
    path = glass.app.records.folders[folder] / ("recordings" if name.endswith("mcap") else "pictures") / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(bytes(size))
    return path


def press(glass: Glass, row: Any, icon: str) -> None:
    (button,) = (one for one in row.walk(restrict=True) if isinstance(one, IconButton) and one.icon == icon)
    button.dispatch("on_release")
    glass.stage.frames(2)


@pytest.mark.usefixtures("setup")
def test_recordings_are_listed_with_their_sizes_the_newest_first(glass: Glass) -> None:
    paths = [kept(glass, "2026-01-02_10-00-00.mcap", 2_500_000), kept(glass, "2026-01-03_10-00-00.jpg", 900)]
    pane = opened(glass, "storage")
    assert list(pane.rows) == [paths[1], paths[0]]
    assert [row.detail for row in pane.rows.values()] == ["900 B", "2.5 MB"]
    assert pane.sum.text == "2 recordings and pictures · 2.5 MB"
    assert pane.where.text == str(glass.app.records.folders[0])


@pytest.mark.usefixtures("setup")
def test_what_is_deleted_comes_back_by_undo_and_is_gone_when_the_pane_is_left(glass: Glass) -> None:
    first, second = kept(glass, "a.mcap", 10), kept(glass, "b.mcap", 20)
    pane = opened(glass, "storage")
    press(glass, pane.rows[first], "delete")
    assert (first.exists(), list(pane.rows)) == (False, [second])
    pane.undo.dispatch("on_release")
    assert first.read_bytes() == bytes(10)
    assert set(pane.rows) == {first, second}
    press(glass, pane.rows[second], "delete")
    glass.app.show_setup("about")
    glass.stage.frames(2)
    assert [path.name for path in first.parent.iterdir()] == ["a.mcap"]


@pytest.mark.usefixtures("setup")
def test_a_recording_that_runs_is_not_deleted(glass: Glass) -> None:
    glass.app.records.toggle(None)
    path = glass.app.records.recorder.path
    pane = opened(glass, "storage")
    press(glass, pane.rows[path], "delete")
    assert path.exists()
    assert pane.problem.text == "It is being recorded: stop the recording first."
    glass.app.records.stop()


@pytest.mark.usefixtures("setup")
def test_a_file_is_opened_by_the_desktop_and_what_cannot_be_is_said(
    glass: Glass, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, asked = kept(glass, "a.mcap", 10), []
    monkeypatch.setattr("app.screens.setup.panes.storage_pane.open_file", asked.append)
    pane = opened(glass, "storage")
    press(glass, pane.rows[path], "folder_open")
    assert asked == [path]

    def nothing(_: Path) -> None:
        raise FileNotFoundError(2, "No such file or directory")

    monkeypatch.setattr("app.screens.setup.panes.storage_pane.open_file", nothing)
    press(glass, pane.rows[path], "folder_open")
    assert pane.problem.text == "It cannot be opened: No such file or directory."


@pytest.mark.parametrize(
    ("count", "words"), [(0, "0 B"), (999, "999 B"), (1500, "1.5 kB"), (2.5e6, "2.5 MB"), (3.21e9, "3.2 GB")]
)
def test_sizes_are_in_words(count: float, words: str) -> None:
    assert size_words(count) == words


@pytest.mark.usefixtures("setup")
def test_about_says_the_version_the_licences_and_leads_to_the_tour(glass: Glass) -> None:
    pane = opened(glass, "about")
    assert app_version()
    glass.tap(pane.buttons["licences"])
    told = "\n".join(part.text for part in pane.text.children)
    assert "Kivy" in told
    assert "SIL OPEN FONT LICENSE" in told.upper()
    pane.buttons["tour"].dispatch("on_release")
    assert glass.app.tour.step == 0


@pytest.mark.usefixtures("setup")
def test_a_sound_is_switched_on_and_tried(glass: Glass, monkeypatch: pytest.MonkeyPatch) -> None:
    played = []
    monkeypatch.setattr(glass.app.sounds, "play", played.append)
    pane = opened(glass, "sounds")
    glass.tap(pane.switches["alarm"].switch)
    assert glass.app.sounds.on["alarm"]
    pane.volume.count(-2)
    assert glass.app.sounds.volume == pytest.approx(0.5)
    pane.try_it.dispatch("on_release")
    assert played == ["alarm"]
    pane.talk.dispatch("on_release")
    glass.stage.frames(3)
    assert glass.app.pages.lone("inputs").screen.chosen == "voice"


@pytest.mark.usefixtures("setup")
def test_text_is_as_large_as_was_chosen(glass: Glass) -> None:
    pane = opened(glass, "text")
    glass.tap(pane.choices.rows[1.5])
    glass.stage.frames(3)
    try:
        assert sp(10) == 15.0
        assert opened(glass, "text").choices.rows[1.5].chosen
    finally:
        Metrics.fontscale = 1.0
