"""The buttons beside the map on the mission screen, as a finger finds them."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import pytest
from kivy.metrics import mm

from app.layout.rects import Rect
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.core.theme import theme

ORDER = ("zoom_in", "zoom_out", "centre", "measure", "fit", "layers", "undo", "redo")
AT = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(3.0, 4.0), Quaternion.from_yaw(0.5))))


@pytest.fixture
def mission(driving: Glass, robot: FakeRobot) -> Any:
    """The mission screen, with the robot's position known."""
    driving.app.show("mission")
    screen = driving.app.screens["mission"]
    robot.publish("/pose", AT)
    driving.until(lambda: screen.map.located, "no pose")
    return screen


def press(driving: Glass, mission: Any, name: str) -> Any:
    button = mission.ids[name]
    driving.tap(button)
    mission.tick()
    return button


def test_one_button_follows_then_has_the_robots_way_up_then_north(driving, mission):
    button = press(driving, mission, "centre")
    assert (mission.map.follow, button.role, button.icon) == (True, "accent", "my_location")
    press(driving, mission, "centre")
    assert button.icon == "navigation"
    assert mission.map.view.turn == pytest.approx(math.pi / 2 - 0.5)
    press(driving, mission, "centre")
    assert button.icon == "my_location"
    assert mission.map.view.turn == 0


def test_a_finger_that_drags_puts_the_light_of_following_out(driving, mission):
    button = press(driving, mission, "centre")
    mission.map.set_view(mission.map.view.moved(40, 0))
    mission.tick()
    assert button.role == "text"


def test_measuring_says_ways_in_the_bar_and_ends_where_it_began(driving, mission):
    button = press(driving, mission, "measure")
    assert (mission.mode, button.role) == ("measure", "accent")
    assert mission.selection.text == "Tap the places to measure between."
    area = mission.map
    for x, y in ((0.0, 0.0), (0.0, 5.0)):
        px, py = area.to_window(*area.view.to_screen(x, y))
        driving.stage.drag([(px, py)])
    assert mission.selection.text == "5.00\u00a0m · 000°"
    assert driving.app.session.mission.draft.points == ()
    press(driving, mission, "measure_done")
    assert mission.mode == "view"
    assert area.measured == []


def test_home_is_where_the_robot_is_by_one_tap(driving, mission):
    mission.mode = "home"
    press(driving, mission, "home_here")
    assert driving.app.session.mission.draft.home == pytest.approx((3.0, 4.0))
    assert mission.mode == "view"


@pytest.mark.parametrize(
    ("body", "form", "left_out"),
    [
        (Rect(0, 60, 412, 774), "tall", {"zoom_in", "zoom_out"}),
        (Rect(68, 0, 824, 364), "short", {"zoom_in", "zoom_out"}),
        (Rect(76, 0, 1204, 744), "wide", set()),
        (Rect(0, 60, 360, 520), "tall", {"zoom_in", "zoom_out", "measure"}),
    ],
)
def test_what_there_is_no_room_for_is_left_out_and_following_never(mission, body, form, left_out):
    mission.arrange(body, form, 1.0)
    buttons = {name: button for name, button in mission.ids.items() if name in ORDER}
    shown = [name for name in ORDER if buttons[name].parent is not None]
    assert {"zoom_in", "zoom_out", "measure"} - set(shown) == left_out
    assert shown[0 if left_out else 2] == "centre"
    tops = [buttons[name].top for name in shown]
    assert all(above - 40 >= below for above, below in pairwise(tops))


@pytest.mark.parametrize(
    ("body", "form"),
    [(Rect(0, 60, 412, 774), "tall"), (Rect(68, 0, 824, 364), "short")],
    ids=["tall", "short"],
)
def test_no_button_is_under_a_card_over_the_map_and_each_comes_back_with_it_gone(
    mission: Any, body: Rect, form: str
) -> None:
    buttons = [mission.ids[name] for name in ORDER]

    def shown() -> list[Any]:
        mission.arrange(body, form, 1.0)
        return [button for button in buttons if button.parent is not None]

    before = shown()
    mission._maps.toggle_card(mission)
    card, left = mission.card.place, shown()
    assert card is not None
    assert not [one for one in left if Rect(*one.pos, *one.size).overlaps(card)]
    if form == "tall":
        assert len(left) < len(before), "some would lie under it"
    mission._maps.toggle_card(mission)
    assert shown() == before


@pytest.mark.parametrize(("gloves", "share"), [(False, 0.02), (False, 0.98), (True, 0.02), (True, 0.98)])
def test_the_edge_of_a_phones_sheet_is_as_high_as_a_finger_needs_and_all_of_it_pulls(
    mission: Any, driving: Glass, gloves: bool, share: float
) -> None:
    theme.gloves = gloves
    try:
        mission.arrange(Rect(0, 60, 412, 774), "tall", 1.0)
        grip = mission.ids.handle
        assert grip.height >= (theme.target if gloves else mm(10)) - 1e-6
        driving.stage.tap(grip.center_x, grip.y + share * grip.height)
        assert mission.sheet == 1, "it is not pulled"
    finally:
        theme.gloves = False
