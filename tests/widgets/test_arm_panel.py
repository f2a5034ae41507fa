from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmState
from widgets.arm_panel import CHOICE, TOLD, ArmPanel
from widgets.theme import theme

POSES = ["rest", "home", "stretch", "look_down"]
HOME = (0.0, -1.05, 0.35, 0.70)


@pytest.fixture
def panel(stage):
    return watched(stage.show(ArmPanel(), size=(326, 228)), stage)


@pytest.fixture
def small(stage):
    return watched(stage.show(ArmPanel(), size=(176, 176)), stage)


def watched(panel, stage):
    panel.orders = []
    panel.bind(on_command=lambda _, order: panel.orders.append(order))
    tell(panel, stage)
    stage.run_for(0.6)
    return panel


def tell(panel, stage, **figures):
    usual = {"angles": HOME, "wanted": HOME, "gripper": 0.04, "pose": "home", "poses": POSES}
    told = {**usual, "tip": Point(0.3, 0.0, 0.2), **figures}
    told["angles"], told["wanted"] = Float64Array(told["angles"]), Float64Array(told["wanted"])
    panel.show(ArmState(**told))
    stage.frames(2)


def key(panel, text):
    return next(child for child in panel.children if child.text.replace("\n", " ") == text)


def tap(stage, panel, text):
    stage.tap(*key(panel, text).center)
    stage.run_for(0.6)


def texts(panel):
    return {child.text.replace("\n", " ") for child in panel.children}


def test_a_pose_is_asked_for_by_its_name(stage, panel):
    tap(stage, panel, "Look down")
    (order,) = panel.orders
    assert order.pose == "look_down"
    assert math.isnan(order.point.x)
    assert math.isnan(order.gripper)


def test_the_gripper_closes_when_it_is_open_and_opens_when_it_is_shut(stage, panel):
    tap(stage, panel, "Close gripper")
    tell(panel, stage, gripper=0.0)
    stage.run_for(0.6)
    tap(stage, panel, "Open gripper")
    assert [(order.pose, order.gripper) for order in panel.orders] == [("", 0.0), ("", panel.open_width)]


def test_a_finger_that_meant_to_close_it_does_not_open_it(stage, panel):
    tell(panel, stage, gripper=0.0)
    stage.tap(*key(panel, "Open gripper").center)
    assert panel.orders == []


def test_where_it_is_small_one_button_opens_the_poses_over_the_picture(stage, small):
    assert texts(small) == {"Poses", "Close"}
    tap(stage, small, "Poses")
    assert texts(small) == {"Rest", "Home", "Stretch", "Look down"}
    tap(stage, small, "Stretch")
    assert [order.pose for order in small.orders] == ["stretch"]
    assert texts(small) == {"Poses", "Close"}


def test_the_poses_close_by_themselves(stage, small):
    tap(stage, small, "Poses")
    stage.run_for(CHOICE + 0.1)
    assert texts(small) == {"Poses", "Close"}
    assert small.orders == []


@pytest.mark.parametrize("size", [(326, 228), (176, 176)])
def test_every_pose_is_reached_where_there_is_no_room_for_all(stage, size):
    panel = watched(stage.show(ArmPanel(), size=size), stage)
    names = [f"pose{number}" for number in range(9)]
    tell(panel, stage, poses=names)
    panel.choosing = True
    stage.frames(2)
    seen = set()
    for _ in range(4):
        seen |= texts(panel)
        tap(stage, panel, "More")
    assert {name.capitalize() for name in names} <= seen


@pytest.mark.parametrize("size", [(326, 228), (176, 176), (228, 330), (520, 330)])
@pytest.mark.parametrize("choosing", [False, True])
def test_the_buttons_are_as_large_as_a_finger_needs_and_do_not_overlap(stage, size, choosing):
    panel = watched(stage.show(ArmPanel(choosing=choosing), size=size), stage)
    boxes = [(child.x, child.y, child.right, child.top) for child in panel.children]
    assert boxes
    for x, y, right, top in boxes:
        assert min(right - x, top - y) >= theme.target - 1
        assert min(x - panel.x, y - panel.y, panel.right - right, panel.top - top) >= 0
    for number, one in enumerate(boxes):
        for other in boxes[number + 1 :]:
            apart = one[2] <= other[0] or other[2] <= one[0] or one[3] <= other[1] or other[3] <= one[1]
            assert apart


@pytest.mark.parametrize(
    ("figures", "word"),
    [
        ({}, "Home"),
        ({"pose": ""}, "at rest"),
        ({"wanted": (0.5, *HOME[1:])}, "moving"),
        ({"touching": True}, "touches something"),
    ],
)
def test_what_it_does_is_told_in_words(stage, panel, figures, word):
    tell(panel, stage, **figures)
    assert panel.texts[1] == word


def test_what_became_of_an_order_is_told_for_a_while(stage, panel):
    panel.answer("refused")
    stage.frames(2)
    assert panel.texts[1] == "refused"
    stage.run_for(TOLD + 0.1)
    assert panel.texts[1] == "Home"


def test_before_the_first_message_there_is_a_dash_and_nothing_to_press(stage):
    panel = stage.show(ArmPanel(state="never"), size=(326, 228))
    assert panel.texts == ["ARM", "–"]
    assert all(child.disabled for child in panel.children)


def test_a_joint_that_is_not_known_is_a_dash(stage, panel):
    tell(panel, stage, angles=(0.0, math.nan, 0.0, 0.0))
    assert "–" in panel.texts


def test_disabled_it_takes_no_finger(stage, panel):
    panel.state = "disabled"
    stage.tap(*key(panel, "Rest").center)
    assert panel.orders == []
