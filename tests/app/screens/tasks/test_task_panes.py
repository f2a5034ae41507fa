"""The panes beside the lists of tasks: made when they are asked for, with all that came before, the way back, and no finger kept."""

from __future__ import annotations

import math
from typing import Any

import pytest
from msgspec.structs import replace

from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.parts.option_list import OPTIONS
from widgets.tasks.place_list import SOME

LAB = SOME[2]
PHONE = (412, 892)
"""[px]"""


@pytest.fixture
def tasks(driving: Glass, robot: FakeRobot) -> Any:
    """Connected, in control, on the tasks screen of a robot that knows some places."""
    robot.know(*SOME)
    driving.app.show("tasks")
    screen = driving.app.screens["tasks"]
    driving.until(lambda: len(screen.places.places) == len(SOME), "no places")
    return screen


def test_a_pane_that_nobody_looks_at_is_not_made_and_one_that_is_made_late_knows_what_came_before(
    driving: Glass, robot: FakeRobot, tasks: Any
) -> None:
    panes = tasks.panes
    assert driving.app.session.feeds.latest("/control/status") is not None
    assert (panes.made_place, panes.made_settings) == (None, None)
    tasks.tab = "places"
    driving.stage.frames(2)
    assert panes.made_settings is None
    assert panes.made_place is tasks.place_pane
    assert panes.made_place.form.taken == [place.name for place in SOME]
    tasks.tabs.dispatch("on_settings")
    assert panes.made_settings is tasks.settings_pane
    assert panes.made_settings.head.sentence == "Kept by the robot, for everybody who uses it.", "at once"
    driving.stage.frames(2)
    assert panes.made_settings.parent is tasks.ids.detail
    assert set(panes.made_settings.options.values) == set(OPTIONS)


def test_a_pane_that_is_made_on_a_phone_has_the_way_back_to_the_lists(driving: Glass, tasks: Any) -> None:
    app, window = driving.app, driving.stage.window
    window.size = app.shell.size = app.root.size = PHONE
    driving.stage.frames(2)
    panes = tasks.panes
    assert (panes.made_place, panes.made_settings) == (None, None)
    for name, opens in (
        ("place", lambda: tasks.edit_place(LAB)),
        ("settings", lambda: tasks.tabs.dispatch("on_settings")),
    ):
        opens()
        pane = getattr(panes, name)
        assert pane.parent is tasks.ids.detail, name
        assert pane.head._back.get_root_window() is window, name
        driving.tap(pane.head._back)
        assert tasks.detail == "", name
        assert pane.parent is None, name


def test_a_finger_on_the_dial_of_a_place_lets_go_when_the_screen_rests(driving: Glass, tasks: Any) -> None:
    tasks.edit_place(replace(LAB, yaw=0.0))
    driving.stage.frames(3)
    form = tasks.form
    x, y = form.dial.to_window(*form.dial.center)
    touch = driving.stage.touch(x + 40, y)
    touch.touch_down()
    touch.touch_move(x, y + 40)
    assert form.yaw == pytest.approx(math.pi / 2)
    tasks.rest()
    touch.touch_move(x - 40, y)
    assert form.yaw == pytest.approx(math.pi / 2)
    touch.touch_up()
