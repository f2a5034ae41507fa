from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmState
from widgets.controls.goals.arm_keys import CHOICE_TIMEOUT
from widgets.controls.goals.arm_panel import OUTCOME_TIMEOUT, ArmPanel
from widgets.controls.goals.arm_picture import side_points
from widgets.core.theme import theme

POSES = ["rest", "home", "stretch", "look_down"]
HOME = (0.0, -1.05, 0.35, 0.70, 0.0)


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
    stage.run_for(CHOICE_TIMEOUT + 0.1)
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


@pytest.mark.parametrize("size", [(326, 228), (176, 176), (268, 176), (228, 330), (520, 330)])
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
        ({"pose": ""}, "still"),
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
    stage.run_for(OUTCOME_TIMEOUT + 0.1)
    assert panel.texts[1] == "Home"


def test_before_the_first_message_there_is_a_dash_and_nothing_to_press(stage):
    panel = stage.show(ArmPanel(state="never"), size=(326, 228))
    assert panel.texts == ["ARM", "–"]
    assert all(child.disabled for child in panel.children)


def test_a_joint_that_is_not_known_is_a_dash(stage, panel):
    tell(panel, stage, angles=(0.0, math.nan, 0.0, 0.0, 0.0))
    assert "–" in panel.texts


def test_disabled_it_takes_no_finger(stage, panel):
    panel.state = "disabled"
    stage.tap(*key(panel, "Rest").center)
    assert panel.orders == []


def tip_of(panel):
    return panel.side.at(side_points(tuple(panel.angles), panel.links)[-1])


def drag(stage, panel, start, way, lift=True):
    """A finger comes down at `start` [px] and goes `way` from there."""
    touch = stage.touch(*start)
    touch.touch_down()
    for share in (0.3, 0.7, 1.0):
        touch.touch_move(start[0] + share * way[0], start[1] + share * way[1])
        stage.frames(1)
    if lift:
        touch.touch_up()
        stage.frames(1)
    return touch


@pytest.mark.parametrize("turned", [0.0, 1.2, -2.0])
def test_the_tip_is_sent_as_far_as_the_finger_went_in_the_plane_of_the_arm(stage, panel, turned):
    tell(panel, stage, angles=(turned, *HOME[1:]), wanted=(turned, *HOME[1:]), pose="")
    metre = panel.side.scale
    drag(stage, panel, (tip_of(panel)[0] + 5, tip_of(panel)[1] - 5), (-0.1 * metre, 0.05 * metre))
    (order,) = panel.orders
    assert (order.pose, len(order.angles)) == ("", 0)
    assert order.point.x == pytest.approx(0.3 - 0.1 * math.cos(turned), abs=0.003)
    assert order.point.y == pytest.approx(-0.1 * math.sin(turned), abs=0.003)
    assert order.point.z == pytest.approx(0.25, abs=0.003)
    assert {type(value) for value in (order.point.x, order.point.y, order.point.z)} == {float}, (
        "as they travel"
    )


def test_nothing_is_asked_for_before_the_finger_is_lifted_nor_by_one_that_only_touched(stage, panel):
    drag(stage, panel, tip_of(panel), (2, 2))
    touch = drag(stage, panel, tip_of(panel), (-30, 20), lift=False)
    assert panel.aim
    assert any(text.startswith("to ") for text in panel.texts)
    panel.rest()
    touch.touch_up()
    assert (panel.orders, panel.aim) == ([], [])


def test_a_finger_on_the_picture_beside_the_tip_moves_nothing(stage, panel):
    x, y = tip_of(panel)
    drag(stage, panel, (x - 2 * theme.target, y - theme.target), (20, 20))
    assert panel.orders == []


def test_where_it_was_sent_is_shown_until_it_is_there(stage, panel):
    drag(stage, panel, tip_of(panel), (-20, 10))
    assert panel.aim
    panel.answer("accepted")
    tell(panel, stage, wanted=(0.0, -1.2, 0.5, 0.6, 0.0))
    assert panel.aim
    there = (0.0, -1.0, 0.2, 0.7, 0.0)
    panel.aim = [float(value) for value in side_points(there, panel.links)[-1]]
    tell(panel, stage, angles=there, wanted=there)
    assert panel.aim == []


def test_where_it_does_not_reach_is_shown_as_long_as_the_refusal(stage, panel):
    drag(stage, panel, tip_of(panel), (20, 40))
    panel.answer("refused")
    tell(panel, stage)
    assert panel.aim
    stage.run_for(OUTCOME_TIMEOUT + 0.1)
    assert panel.aim == []


def test_the_hand_of_the_dial_turns_the_foot_and_leaves_the_other_joints(stage, panel):
    x, y, radius = panel.dials["turn"]
    drag(stage, panel, (x, y + radius / 2), (-60, -radius / 2))
    (order,) = panel.orders
    assert list(order.angles) == pytest.approx([math.pi / 2, *HOME[1:]], abs=0.02)


def test_the_hand_of_the_lower_dial_rolls_the_hand_and_leaves_the_other_joints(stage, panel):
    x, y, radius = panel.dials["roll"]
    drag(stage, panel, (x, y - radius / 2), (60, radius / 2))
    (order,) = panel.orders
    assert list(order.angles) == pytest.approx([*HOME[:4], math.pi / 2], abs=0.02)
    assert {"foot 0°", "hand 0°"} <= set(panel.texts)
    tell(panel, stage, angles=(*HOME[:4], -0.5), wanted=(*HOME[:4], -0.5))
    assert "hand 29° left" in panel.texts


@pytest.mark.parametrize(
    ("size", "words"), [((176, 176), ("foot 0°", "hand 29°L")), ((268, 176), ("foot 0°", "hand 29° left"))]
)
def test_where_there_is_no_room_for_its_dial_the_figure_of_the_hand_is_seen(stage, size, words):
    panel = watched(stage.show(ArmPanel(), size=size), stage)
    tell(panel, stage, angles=(*HOME[:4], -0.5), wanted=(*HOME[:4], -0.5))
    assert [*panel.dials] == ["turn"]
    assert set(words) <= set(panel.texts)
    tell(panel, stage, angles=HOME[:4], wanted=HOME[:4])
    assert not any(text.startswith("hand") for text in panel.texts)


@pytest.mark.parametrize("size", [(326, 228), (176, 176), (520, 330)])
def test_the_pose_that_it_is_in_is_outlined_and_written_as_large_as_the_others(stage, size):
    panel = watched(stage.show(ArmPanel(choosing=True), size=size), stage)
    before = key(panel, "Look down").words_size
    tell(panel, stage, pose="look_down")
    here, other = key(panel, "Look down"), key(panel, "Home")
    assert here.words_size == before
    assert here.rim_width > other.rim_width
    tell(panel, stage, pose="home")
    assert (here.rim_width, other.icon) == (theme.outline, "check")


def test_an_arm_with_four_joints_is_drawn_and_led_without_a_dial_for_its_hand(stage, panel):
    tell(panel, stage, angles=HOME[:4], wanted=HOME[:4])
    assert [*panel.dials] == ["turn"]
    panel.turn(0.5)
    drag(stage, panel, tip_of(panel), (-20, 10))
    turned, led = panel.orders
    assert list(turned.angles) == [0.5, *HOME[1:4]]
    assert math.isfinite(led.point.x)


@pytest.mark.parametrize("count", [0, 3, 6])
def test_of_an_arm_with_other_joints_the_poses_and_the_gripper_are_left(stage, panel, count):
    tell(panel, stage, angles=(0.1,) * count, wanted=(0.1,) * count)
    assert "–" in panel.texts
    tap(stage, panel, "Look down")
    tap(stage, panel, "Close gripper")
    assert [order.pose for order in panel.orders] == ["look_down", ""]


def test_disabled_its_tip_is_not_dragged(stage, panel):
    panel.state = "disabled"
    drag(stage, panel, tip_of(panel), (-40, 20))
    assert (panel.orders, panel.aim) == ([], [])
