from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import GetMissionsResponse, KeptMission
from widgets.parts.rows import ListRow
from widgets.tasks.mission_list import NOON, SOME, MissionList, mission_words


@pytest.fixture
def missions(stage):
    widget = stage.show(MissionList(now=NOON), size=(388, 300))
    widget.show(GetMissionsResponse(missions=SOME))
    stage.frames(3)
    return widget


def rows(widget):
    return {one.title: one for one in widget.walk(restrict=True) if isinstance(one, ListRow)}


@pytest.mark.parametrize(
    ("mission", "words"),
    [
        (KeptMission("a", points=1, motion="loop", revisions=1), "1 point · loop"),
        (KeptMission("a", points=6, motion="random", revisions=3), "6 points · random · 3 revisions"),
    ],
)
def test_a_mission_is_told_in_a_few_words(mission, words):
    assert mission_words(mission) == words


def test_each_is_told_with_when_it_was_stored(missions):
    night = rows(missions)["Night"]
    assert night.detail == "14 points · random · 6 revisions"
    assert night.aside.startswith("Tue ")


def test_the_one_that_the_robot_patrols_is_marked_by_words(missions):
    missions.current = "Night"
    assert rows(missions)["Night"].detail.startswith("Current mission · ")
    assert not rows(missions)["East wing"].detail.startswith("Current mission")


def test_a_tap_says_which(stage, missions):
    heard = []
    missions.bind(on_command=lambda _, mission: heard.append(mission.name))
    row = rows(missions)["East wing"]
    stage.tap(*row.to_window(*row.center))
    stage.frames(2)
    assert heard == ["East wing"]


def test_none_are_said(stage):
    widget = stage.show(MissionList(), size=(388, 300))
    assert widget.ids.column.children[0].text == "The robot has no stored missions."
