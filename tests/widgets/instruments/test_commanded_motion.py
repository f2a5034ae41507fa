from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import MANOEUVRES, Manoeuvre
from widgets.instruments.commanded_motion import KINDS, CommandedMotion

SWIM = Twist(Vector3(0.45, 0.0, -0.10), Vector3(0.0, 0.0, math.radians(8)))


@pytest.fixture
def motion(stage):
    return stage.show(CommandedMotion(state="live", under_water=True), size=(326, 228))


def told(motion):
    return {figure.name: f"{figure.text} {figure.unit}".strip() for figure in motion.figures}


def test_a_twist_is_told_as_surge_heave_and_yaw(motion):
    motion.show(Manoeuvre(kind="twist", twist=SWIM))
    assert told(motion) == {"Surge": "0.45 m/s", "Heave": "−0.10 m/s", "Yaw": "+8 °/s"}
    assert motion.word == "Speeds"


def test_before_the_first_order_there_are_dashes_and_no_zeros(stage, motion):
    assert set(told(motion).values()) == {"— m/s", "— °/s"}
    assert not [text for text in motion.texts if "0" in text]


def test_what_was_once_asked_for_keeps_its_place(motion):
    motion.show(Manoeuvre(kind="twist", twist=Twist(Vector3(0.0, 0.2), Vector3(0.1))))
    motion.show(Manoeuvre(kind="twist", twist=SWIM))
    assert list(told(motion)) == ["Surge", "Sway", "Heave", "Roll", "Yaw"]


def test_a_course_tells_heading_and_depth_to_hold(motion):
    motion.show(Manoeuvre(kind="course", speed=0.5, yaw=0.0, height=-4.5))
    assert told(motion) == {"Surge": "0.50 m/s", "Heading": "090°", "Target depth": "4.5 m"}


def test_a_throttle_is_told_where_there_is_no_speed(motion):
    motion.show(Manoeuvre(kind="steer", throttle=0.6, steering=math.radians(-12)))
    assert told(motion) == {"Throttle": "60 %", "Steer": "−12°"}


def test_a_tilt_tells_pitch_and_roll_with_climb_and_turn(motion):
    motion.show(Manoeuvre(kind="tilt", twist=SWIM, roll=math.radians(5), pitch=math.radians(-11)))
    assert told(motion) == {"Pitch": "−11°", "Roll": "+5°", "Heave": "−0.10 m/s", "Yaw": "+8 °/s"}


def test_a_depth_that_is_held_beside_the_order_is_told_too(motion):
    motion.show(Manoeuvre(kind="twist", twist=SWIM))
    motion.target = 4.5
    assert told(motion)["Target depth"] == "4.5 m"
    motion.under_water = False
    assert told(motion)["Target height"] == "4.5 m"


def test_a_heading_that_is_not_said_is_the_present_one(motion):
    motion.show(Manoeuvre(kind="hover"))
    assert told(motion) == {"Heading": "as now"}


def test_a_kind_nobody_knows_is_named_and_no_figure_is_made_up_for_it(stage, motion):
    motion.show(Manoeuvre(kind="barrel_roll", twist=SWIM))
    stage.frames(2)
    assert motion.texts == ["COMMANDED", "Barrel roll", "Barrel roll"]


def test_every_kind_has_a_word():
    assert set(KINDS) == set(MANOEUVRES)


@pytest.mark.parametrize("kind", MANOEUVRES)
@pytest.mark.parametrize("size", [(176, 176), (326, 228), (420, 96), (300, 54)])
def test_every_kind_has_room_for_what_is_to_be_held(stage, kind, size):
    motion = stage.show(CommandedMotion(state="live", target=4.5), size=size)
    motion.show(Manoeuvre(kind=kind, twist=Twist(Vector3(0.4, 0.2, -0.1), Vector3(0.1, 0.1, 0.1))))
    stage.frames(2)
    assert motion.texts.count("4.5") == 1
