from __future__ import annotations

import math

import pytest

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import MotorArray
from bridge.msgs.sensor_msgs import JointState
from widgets.core.shapes import Shapes
from widgets.instruments.leg_panel import MAX_LEGS, LegPanel, leg_of
from widgets.parts.sensor_card import wide


@pytest.fixture
def panel(stage):
    return stage.show(LegPanel(state="live"), size=(326, 228))


def joints(**degrees: float) -> JointState:
    radians = Float64Array([math.radians(value) for value in degrees.values()])
    return JointState(name=[f"{name}_leg_joint" for name in degrees], position=radians)


def motors(**warmth: float) -> MotorArray:
    return MotorArray(names=list(warmth), temperatures=Float64Array(list(warmth.values())))


@pytest.mark.parametrize(
    ("name", "leg"),
    [
        ("front_left_leg_joint", "L1"),
        ("middle_left", "L2"),
        ("rear_right", "R3"),
        ("hind_right_hip", "R3"),
        ("wheel_left_joint", ""),
        ("propeller", ""),
        ("leftover_front", ""),
    ],
)
def test_a_leg_is_called_by_its_side_and_row(name, leg):
    assert leg_of(name) == leg


def test_each_leg_has_its_angle_and_temperature(stage, panel):
    panel.show(joints(front_left=22.4, rear_right=-9.0))
    panel.show(motors(front_left=34.2, rear_right=35.0))
    stage.frames(2)
    assert panel.texts == ["LEGS", "L1", "22°", "34 °C", "R3", "−9°", "35 °C"]


def test_before_anything_is_heard_every_leg_has_a_dash(stage, panel):
    assert panel.texts == ["LEGS", *(text for leg in panel.legs for text in (leg, "–"))]
    assert panel.legs == ["L1", "L2", "L3", "R1", "R2", "R3"]


@pytest.mark.parametrize(
    ("warmth", "role"), [(44.0, "muted"), (45.0, "warn"), (60.0, "danger"), (math.nan, "muted")]
)
def test_a_motor_that_is_too_warm_has_a_warning_colour(panel, warmth, role):
    panel.show(motors(front_left=warmth))
    assert panel.role("L1") == role


def test_the_warmest_is_named_in_words(stage, panel):
    panel.show(motors(front_left=52.0, middle_right=63.0, rear_left=math.nan))
    stage.frames(2)
    assert panel.texts[1] == "R2 is hot"
    panel.show(motors(middle_right=40.0))
    stage.frames(2)
    assert panel.texts[1] == "L1 is warm"


def test_where_it_is_low_the_warmest_is_told(stage):
    panel = stage.show(LegPanel(state="live"), size=(120, 54))
    panel.show(motors(front_left=52.0, middle_right=63.0))
    stage.frames(2)
    assert panel.texts == ["legs · R2 63 °C"]


def test_what_is_no_leg_is_left_alone(panel):
    panel.show(JointState(name=["wheel_left_joint"], position=Float64Array([1.0])))
    panel.show(MotorArray(names=["propeller"], temperatures=Float64Array([90.0])))
    assert (dict(panel.angles), dict(panel.temperatures)) == ({}, {})


def test_a_message_with_fewer_values_than_names_tells_nothing_of_the_others(panel):
    panel.show(MotorArray(names=["front_left", "front_right"], temperatures=Float64Array([30.0])))
    assert panel.temperatures["L1"] == 30.0
    assert math.isnan(panel.temperatures["R1"])


def test_noise_below_what_is_read_is_not_drawn_anew(panel):
    panel.show(joints(front_left=22.0, rear_left=math.nan))
    drawn = []
    panel.bind(angles=lambda *_: drawn.append(1))
    panel.show(joints(front_left=22.3, rear_left=math.nan))
    assert not drawn
    panel.show(joints(front_left=23.0, rear_left=math.nan))
    assert drawn == [1]


def test_no_more_legs_are_drawn_than_have_room(panel):
    panel.angles = {f"L{number}": 0.0 for number in range(40)}
    assert len(panel.legs) == MAX_LEGS


@pytest.mark.parametrize("size", [(176, 176), (190, 132), (150, 300), (420, 110), (480, 330)])
def test_the_figures_stay_inside(stage, size):
    panel = stage.show(LegPanel(state="live"), size=size)
    sides = ("front_left", "middle_left", "rear_left", "front_right", "middle_right", "rear_right")
    panel.show(joints(**dict.fromkeys(sides, -138.0)))
    panel.show(motors(**dict.fromkeys(sides, 104.0)))
    stage.frames(2)
    for word in panel.marks(Shapes()):
        if word.font == "Icons":
            continue
        left = word.x - wide(word.text, word.size, bold=word.bold) * word.anchor[0]
        assert left >= panel.x, word.text
        assert left + wide(word.text, word.size, bold=word.bold) <= panel.right, word.text
        assert panel.y <= word.y - word.size / 2, word.text


@pytest.mark.parametrize("size", [(300, 110), (176, 176), (110, 150), (260, 140), (326, 60)])
def test_a_small_panel_that_has_heard_nothing_says_so_of_every_leg(stage, size):
    panel = stage.show(LegPanel(), size=size)
    stage.frames(2)
    assert "–" in "".join(panel.texts)


@pytest.mark.parametrize(("told", "shown"), [(-186.0, 174.0), (725.0, 5.0), (-180.0, 180.0), (-90.0, -90.0)])
def test_a_fin_that_turns_on_and_on_is_told_within_half_a_turn(panel, told, shown):
    panel.show(joints(front_left=told))
    assert panel.angles["L1"] == shown
