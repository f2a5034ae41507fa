"""Turn, bank and pitch: the signs of REP-103 as people say them, and what is unknown is no zero."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import (
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import Imu
from widgets.instruments.turn_tape import TurnTape

UNMEASURED = [-1.0, *[0.0] * 8]


@pytest.fixture
def tape(stage):
    return stage.show(TurnTape(state="live"), size=(320, 150))


def leaning(roll: float = 0.0, pitch: float = 0.0) -> Quaternion:
    """By REP-103 [deg]: a roll above 0 has the right side down, a pitch above 0 the bow."""
    if roll:
        return Quaternion(math.sin(math.radians(roll) / 2), 0.0, 0.0, math.cos(math.radians(roll) / 2))
    return Quaternion(0.0, math.sin(math.radians(pitch) / 2), 0.0, math.cos(math.radians(pitch) / 2))


def said(stage, tape) -> list[str]:
    stage.frames(2)
    return [text for text in tape.texts if text[:1].isdigit() or text == "—"]


@pytest.mark.parametrize(("rate", "words"), [(0.5, "29°/s left"), (-0.5, "29°/s right"), (0.0, "0°/s")])
def test_a_turn_is_said_with_its_side(stage, tape, rate, words):
    tape.show(Imu(orientation=Quaternion(w=1.0), angular_velocity=Vector3(z=rate)))
    assert said(stage, tape)[0] == words


@pytest.mark.parametrize(
    ("way", "bank", "pitch"),
    [
        (leaning(roll=10), "10° right", "0°"),
        (leaning(roll=-10), "10° left", "0°"),
        (leaning(pitch=10), "0°", "10° down"),
        (leaning(pitch=-10), "0°", "10° up"),
    ],
)
def test_a_lean_is_said_with_its_side(stage, tape, way, bank, pitch):
    tape.show(Imu(orientation=way))
    assert said(stage, tape)[1:] == [bank, pitch]


def test_what_an_imu_does_not_measure_is_unknown(stage, tape):
    tape.show(Imu(orientation=Quaternion(w=1.0), orientation_covariance=UNMEASURED))
    assert said(stage, tape) == ["0°/s", "—", "—"]
    tape.show(Imu(orientation=Quaternion(w=1.0), angular_velocity_covariance=UNMEASURED))
    assert said(stage, tape) == ["—", "0°", "0°"]
    tape.show(Imu(orientation=Quaternion(0.0, 0.0, 0.0, 0.0)))
    assert said(stage, tape)[1:] == ["—", "—"]


def test_before_the_first_message_nothing_is_zero(stage, tape):
    tape.state = "never"
    assert said(stage, tape) == ["—", "—", "—"]


def test_odometry_says_it_too(stage, tape):
    tape.show(
        Odometry(
            pose=PoseWithCovariance(Pose(orientation=leaning(roll=5))),
            twist=TwistWithCovariance(Twist.planar(0.3, 0.2)),
        )
    )
    assert said(stage, tape) == ["11°/s left", "5° right", "0°"]


def test_a_lean_that_is_much_has_a_sign(stage, tape):
    tape.show(Imu(orientation=leaning(roll=10)))
    stage.frames(2)
    calm = len(tape.texts)
    tape.show(Imu(orientation=leaning(roll=-25)))
    stage.frames(2)
    assert len(tape.texts) == calm + 1


@pytest.mark.parametrize(("height", "count"), [(60, 1), (100, 2), (150, 3), (400, 3)])
def test_there_are_as_many_scales_as_there_is_room_for(stage, tape, height, count):
    tape.height = height
    tape.show(Imu(orientation=Quaternion(w=1.0)))
    assert len(said(stage, tape)) == count


def test_noise_that_nobody_sees_draws_nothing_anew(tape):
    tape.show(Imu(orientation=Quaternion(w=1.0), angular_velocity=Vector3(z=0.5)))
    before = tape.turn_rate
    tape.show(Imu(orientation=Quaternion(w=1.0), angular_velocity=Vector3(z=0.5005)))
    assert tape.turn_rate == before


def inked(ink) -> list[float]:
    return [float(value) for value in ink._mesh.vertices]


@pytest.mark.parametrize("rate", [-2.0, 0.0, 0.4])
def test_after_many_messages_it_looks_like_one_that_is_new(stage, tape, rate):
    for turn, roll in ((0.9, 3), (-0.3, -28), (rate, 12)):
        tape.show(Imu(orientation=leaning(roll=roll), angular_velocity=Vector3(z=turn)))
        stage.frames(2)
    fresh = TurnTape(state="live", size=tape.size, pos=tape.pos)
    fresh.show(Imu(orientation=leaning(roll=12), angular_velocity=Vector3(z=rate)))
    fresh.draw()
    assert inked(tape._ink) == inked(fresh._ink)
    assert inked(tape._still) == inked(fresh._still)


def test_the_scales_follow_the_room_and_the_state(stage, tape):
    tape.show(Imu(orientation=Quaternion(w=1.0)))
    stage.frames(2)
    seen = [inked(tape._still)]
    for change in ({"width": 250}, {"y": 40}, {"state": "alarm"}, {"height": 60}):
        for name, value in change.items():
            setattr(tape, name, value)
        stage.frames(2)
        seen.append(inked(tape._still))
    assert len({tuple(each) for each in seen}) == len(seen)
