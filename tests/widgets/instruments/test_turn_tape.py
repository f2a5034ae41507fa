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
from widgets.core.language import language
from widgets.core.theme import theme
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


def looks(tape) -> tuple[list[float], ...]:
    """Vertices of scales, pointers and marks, and what is written where in which colour."""
    words = [tape._words, *tape._figures]
    slots = [slot for one in words for slot in one._slots if slot[1].size[0]]
    written = [(tuple(colour.rgba), *text.pos, *text.size, text.texture) for colour, text in slots]
    return (*(list(sheet.vertices) for sheet in (tape._still, tape._moving, tape._over)), written)


@pytest.mark.parametrize("rate", [-2.0, 0.0, 0.01, 0.4])
@pytest.mark.parametrize("roll", [12, -25])
def test_after_many_messages_it_looks_like_one_that_is_new(stage, tape, rate, roll):
    unknown = Imu(orientation_covariance=UNMEASURED, angular_velocity_covariance=UNMEASURED)
    tape.show(unknown)
    stage.frames(2)
    for turn, lean in ((0.9, 3), (-0.3, -28), (1.7, 40), (rate, roll)):
        tape.show(Imu(orientation=leaning(roll=lean), angular_velocity=Vector3(z=turn)))
        stage.frames(2)
    fresh = TurnTape(state="live", size=tape.size, pos=tape.pos)
    fresh.show(Imu(orientation=leaning(roll=roll), angular_velocity=Vector3(z=rate)))
    fresh.draw()
    assert looks(tape) == looks(fresh)


@pytest.mark.parametrize(
    "change",
    [
        {"width": 250},
        {"y": 40},
        {"state": "alarm"},
        {"state": "never"},
        {"height": 60},
        {"max_turn_rate": 20.0},
        {"warn_lean": 5.0},
        {"card": False},
    ],
    ids=str,
)
def test_it_follows_the_room_the_state_and_its_limits(stage, tape, change):
    message = Imu(orientation=leaning(roll=12), angular_velocity=Vector3(z=0.5))
    tape.show(message)
    stage.frames(2)
    before = looks(tape)
    for name, value in change.items():
        setattr(tape, name, value)
    stage.frames(2)
    fresh = TurnTape(size=tape.size, pos=tape.pos, **{"state": "live", **change, "y": tape.y})
    fresh.show(message)
    fresh.draw()
    assert looks(tape) == looks(fresh) != before


@pytest.mark.parametrize(("which", "chosen", "usual"), [(theme, "sunlight", "dark"), (language, "de", "en")])
def test_it_follows_the_theme_and_the_language(stage, tape, which, chosen, usual):
    message = Imu(orientation=leaning(roll=12), angular_velocity=Vector3(z=0.5))
    tape.show(message)
    stage.frames(2)
    before = looks(tape)
    which.name = chosen
    try:
        tape.redraw()
        stage.frames(2)
        fresh = TurnTape(state="live", size=tape.size, pos=tape.pos)
        fresh.show(message)
        fresh.draw()
        assert looks(tape) == looks(fresh) != before
    finally:
        which.name = usual


def test_a_scale_that_comes_back_makes_nothing_new(stage, tape):
    tape.show(Imu(orientation=leaning(roll=12)))
    stage.frames(2)
    before, parts = looks(tape), list(tape.canvas.children)
    for height in (60, 100, 150):
        tape.height = height
        stage.frames(2)
    assert looks(tape) == before
    assert list(tape.canvas.children) == parts
