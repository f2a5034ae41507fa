"""Which profile a robot is shown by: its own where one was chosen, the built-in one otherwise and whenever its own is wrong."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from app.core.settings_store import Settings
from app.layout.layout_choice import LayoutChoice
from app.layout.views import Panel, View
from app.profiles.profile_choice import ProfileChoice
from app.profiles.profile_store import ProfileStore
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets import CATALOGUE

ROBOT, OTHER = RobotInfo(name="Patrol-1", model="patrol"), RobotInfo(name="Scout-1", model="scout")
VIEWS = (View("A", (Panel("Compass", "/pose"),)),)


class Bench:
    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.settings = Settings(folder)
        self.choice = self.anew()

    def anew(self) -> ProfileChoice:
        """As after a restart of the app, with the same settings."""
        store = ProfileStore(self.folder / "profiles", CATALOGUE)
        return ProfileChoice(LayoutChoice(CATALOGUE), store, self.settings)


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    bench = Bench(tmp_path)
    yield bench
    bench.settings.close()


def test_a_robot_without_a_profile_of_its_own_has_the_built_in_one(bench: Bench) -> None:
    assert bench.choice.of(ROBOT).name == "patrol"
    assert bench.choice.chosen(ROBOT) == ""


def test_what_was_changed_for_a_robot_is_there_after_a_restart_and_for_no_other(bench: Bench) -> None:
    told: list[int] = []
    bench.choice.on_change = lambda: told.append(1)
    kept = bench.choice.save(ROBOT, replace(bench.choice.of(ROBOT), views=VIEWS))
    assert told == [1]
    again = bench.anew()
    assert again.of(ROBOT) == kept
    assert again.of(ROBOT).views == VIEWS
    assert again.of(OTHER).name == "scout"


def test_a_second_change_replaces_the_first_under_the_same_name(bench: Bench) -> None:
    first = bench.choice.save(ROBOT, replace(bench.choice.of(ROBOT), views=VIEWS))
    second = bench.choice.save(ROBOT, replace(first, views=()))
    assert second.name == first.name
    assert bench.anew().of(ROBOT).views == ()


def test_a_profile_of_views_alone_has_the_drive_screen_of_each_robot_and_never_writes_it(
    bench: Bench,
) -> None:
    path = bench.choice.store.path("mine")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("title = 'Mine'\narrangement = 'columns'\n[[view]]\ntitle = 'A'\n")
    for robot in (ROBOT, OTHER):
        bench.choice.choose(robot, "mine")
        shown, built_in = bench.choice.of(robot), bench.choice.built_in(robot)
        assert shown == built_in.__class__(
            "mine", "Mine", built_in.instruments, built_in.arrangement, (), built_in.controls, built_in.actions, shown.views
        )  # fmt: skip
        assert shown.controls
        assert [view.title for view in shown.views] == ["A"]
    kept = bench.choice.save(ROBOT, replace(bench.choice.of(ROBOT), views=VIEWS))
    assert kept.controls == bench.choice.built_in(ROBOT).controls
    assert bench.choice.of(ROBOT) == kept
    assert "[[control]]" not in path.read_text()
    assert bench.anew().of(OTHER).controls == bench.choice.built_in(OTHER).controls


def test_a_profile_that_has_a_drive_screen_of_its_own_keeps_it(bench: Bench) -> None:
    own = replace(bench.choice.of(ROBOT), controls=(), actions=(), views=VIEWS)
    bench.choice.save(ROBOT, own)
    assert bench.anew().of(ROBOT).controls == ()
    assert bench.anew().of(ROBOT).instruments == own.instruments


def test_a_profile_with_faults_is_told_whole_and_the_built_in_one_shown(bench: Bench) -> None:
    bench.choice.save(ROBOT, replace(bench.choice.of(ROBOT), views=VIEWS))
    path = bench.choice.store.path(bench.choice.chosen(ROBOT))
    path.write_text("title = 3\ncolour = 4")
    again = bench.anew()
    assert again.of(ROBOT).name == "patrol"
    assert [fault.line for fault in again.faults] == [1, 2]
    assert again.mistake.endswith("1 more: see Panels.")
    assert path.read_text() == "title = 3\ncolour = 4"
    again.of(OTHER)
    assert again.faults == ()


def test_a_profile_whose_file_is_gone_is_said(bench: Bench) -> None:
    bench.choice.choose(ROBOT, "gone")
    assert bench.choice.of(ROBOT).name == "patrol"
    assert "Layout gone cannot be read" in bench.choice.mistake


def test_the_built_in_profile_can_be_chosen_again(bench: Bench) -> None:
    bench.choice.save(ROBOT, replace(bench.choice.of(ROBOT), views=VIEWS))
    bench.choice.choose(ROBOT, "")
    assert bench.anew().of(ROBOT).name == "patrol"


def test_a_profile_from_elsewhere_takes_the_place_of_none(bench: Bench) -> None:
    mine = bench.choice.save(ROBOT, replace(bench.choice.of(ROBOT), views=VIEWS))
    theirs = bench.choice.adopt(ROBOT, replace(mine, title=mine.name, views=(), robots=("patrol",)))
    assert theirs.name != mine.name
    assert theirs.robots == (), "it does not claim robots of others"
    assert bench.anew().of(ROBOT) == theirs
    assert bench.choice.store.load(mine.name) == mine


def test_settings_that_a_hand_has_spoilt_choose_nothing(bench: Bench) -> None:
    for spoilt in (3, {"Patrol-1": 4}, ["patrol"], {"Patrol-1": "../../secret"}):
        bench.settings.set("profiles", spoilt)
        assert bench.anew().chosen(ROBOT) == ""
