"""A layout that comes from outside is shown first, and used for a robot only when somebody says so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from kivy.core.window import Window

from app.layout.layout import load
from app.layout.layout_text import text_of
from app.layout.views import Panel, View
from app.profiles.profile_link import link_of
from app.screens.panels.sharing.take_in_dialog import TakeInDialog
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets import CATALOGUE

NIGHT = replace(
    load("patrol", CATALOGUE),
    title="Night shift",
    views=(View("Round", (Panel("Compass", "/pose"), Panel("ToggleSwitch", "/lamp"))),),
)
LINK = link_of(text_of(NIGHT))


def dialog(glass: Glass) -> TakeInDialog | None:
    glass.stage.frames(2)
    return next((child for child in glass.app.root.children if isinstance(child, TakeInDialog)), None)


def chosen(glass: Glass) -> str:
    return glass.app.profiles.chosen(glass.app.session.robot.info)


def test_a_link_is_shown_with_its_views_and_switches_and_used_when_it_is_asked_for(driving: Glass) -> None:
    driving.app.robot_list.trust.open_link(LINK)
    asked = dialog(driving)
    assert asked is not None
    assert asked.told.splitlines()[0] == "Night shift"
    assert asked.told.splitlines()[-2:] == ["Round: 2 panels", "Switches for: /lamp"]
    assert chosen(driving) == ""
    driving.tap(asked.ids.use)
    assert dialog(driving) is None
    assert chosen(driving) == "night-shift"
    driving.app.show("panels")
    assert driving.app.screens["panels"].views == NIGHT.views


def test_what_is_not_wanted_leaves_nothing_behind(driving: Glass) -> None:
    driving.app.robot_list.trust.open_link(LINK)
    asked = dialog(driving)
    assert asked is not None
    driving.tap(asked.ids.cancel)
    assert dialog(driving) is None
    assert (chosen(driving), driving.app.profiles.store.names()) == ("", [])


def test_a_link_that_is_cut_is_said_in_a_sentence(driving: Glass) -> None:
    driving.app.robot_list.trust.open_link(LINK[:-9])
    assert dialog(driving) is None
    assert any("not complete" in text for text in driving.banners())


def test_without_a_robot_it_waits_for_the_first_that_answers_and_asks_again(
    glass: Glass, robot: FakeRobot
) -> None:
    glass.app.robot_list.trust.open_link(LINK)
    asked = dialog(glass)
    assert asked is not None
    assert asked.ids.use.disabled
    assert "connect to that one" in asked.what
    asked.close()
    glass.app.open(robot.url)
    glass.until(lambda: (found := dialog(glass)) is not None and found.usable, "it is not asked about")
    asked = dialog(glass)
    assert asked is not None
    assert "Fake-1" in asked.what


@pytest.mark.parametrize(
    ("name", "text", "problem"),
    [("views.toml", "title = 3", "It has a fault"), ("map.png", "", "is no layout")],
)
def test_a_file_that_is_dropped_and_is_no_layout_is_said_so(
    driving: Glass, tmp_path: Path, name: str, text: str, problem: str
) -> None:
    path = tmp_path / name
    path.write_text(text)
    Window.dispatch("on_drop_file", str(path).encode(), 10, 10)
    asked = dialog(driving)
    said = [*driving.banners(), *([asked.told] if asked else [])]
    assert any(problem in sentence for sentence in said)
    assert asked is None or not asked.usable


def test_a_file_that_is_dropped_is_asked_about(driving: Glass, tmp_path: Path) -> None:
    path = tmp_path / "night.toml"
    path.write_text(text_of(NIGHT))
    Window.dispatch("on_drop_file", str(path).encode(), 10, 10)
    asked = dialog(driving)
    assert asked is not None
    assert asked.usable


def test_what_is_under_change_ends_when_another_layout_is_used(driving: Glass) -> None:
    driving.app.show("panels")
    screen = driving.app.screens["panels"]
    driving.until(lambda: screen.acts.buttons["edit"].disabled is False, "nothing to edit")
    screen.editor.begin()
    screen.editor.add_view()
    driving.app.robot_list.trust.open_link(LINK)
    asked = dialog(driving)
    assert asked is not None
    driving.tap(asked.ids.use)
    driving.stage.frames(2)
    assert not screen.editing
    assert driving.app.screens["panels"].views == NIGHT.views
