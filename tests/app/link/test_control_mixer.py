"""Piloting: several controls make one order, in the words that the robot knows."""

from __future__ import annotations

import math

import pytest

from app.link.control_mixer import ControlMixer, Parts, Reach, order
from app.link.drive_slot import Drive
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre

REACH = Reach(speed=2.0, yaw_rate=1.0, climb=1.0, tilt=0.4, steering=0.5)
STICK = ("ahead", "turn")
TRUCK = ("ahead", "steering")
BOAT = ("throttle", "steering")
DRONE = ("climb", "turn", "roll", "pitch")
SWIMMER = ("ahead", "turn", "climb", "roll", "pitch")


def test_a_stick_alone_says_a_twist_to_every_robot() -> None:
    said = order(Parts(ahead=0.4, turn=-0.3), ("twist", "steer", "tilt"), REACH, STICK)
    assert said == Twist.planar(0.4, -0.3)


def test_a_truck_is_told_speed_and_angle_of_its_wheels_and_goes_straight_in_the_same_words() -> None:
    turning = order(Parts(ahead=1.5, steering=0.2), ("twist", "steer"), REACH, TRUCK)
    assert (turning.kind, turning.speed, turning.steering) == ("steer", 1.5, 0.2)
    assert math.isnan(turning.throttle)
    straight = order(Parts(ahead=1.5), ("twist", "steer"), REACH, TRUCK)
    assert (straight.kind, straight.speed, straight.steering) == ("steer", 1.5, 0.0)
    standing = order(Parts(steering=-0.2), ("twist", "steer"), REACH, TRUCK)
    assert (standing.speed, standing.steering) == (0.0, -0.2), "the wheels are turned where it stands"


def test_a_boat_is_told_throttle_and_rudder() -> None:
    said = order(Parts(throttle=-0.5, steering=0.1), ("twist", "steer"), REACH, BOAT)
    assert (said.kind, said.throttle, said.steering) == ("steer", -0.5, 0.1)
    assert math.isnan(said.speed)


def test_stick_and_circle_of_a_drone_make_one_order() -> None:
    said = order(Parts(climb=0.5, turn=0.2, roll=-0.1, pitch=0.3), ("twist", "tilt"), REACH, DRONE)
    assert (said.kind, said.roll, said.pitch) == ("tilt", -0.1, 0.3)
    assert said.twist == Twist(Vector3(0.0, 0.0, 0.5), Vector3(0.0, 0.0, 0.2))
    assert math.isnan(said.speed)


def test_a_drone_whose_circle_is_let_go_stands_still_in_the_air_while_it_climbs() -> None:
    said = order(Parts(climb=0.5), ("twist", "tilt"), REACH, DRONE)
    assert said == Twist(Vector3(0.0, 0.0, 0.5))


def test_a_swimmer_whose_circle_is_let_go_is_level_while_it_goes_ahead() -> None:
    said = order(Parts(ahead=0.4), ("twist", "tilt"), REACH, SWIMMER)
    assert (said.kind, said.speed, said.roll, said.pitch) == ("tilt", 0.4, 0.0, 0.0)


@pytest.mark.parametrize(
    ("parts", "says", "twist"),
    [
        (Parts(ahead=1.0, steering=0.25), TRUCK, Twist.planar(1.0, 0.5)),
        (Parts(throttle=0.5, steering=-0.5), BOAT, Twist.planar(1.0, -1.0)),
        (Parts(roll=0.2, pitch=0.4, climb=0.5), DRONE, Twist(Vector3(2.0, -1.0, 0.5))),
    ],
)
def test_to_a_robot_that_knows_twists_alone_the_same_push_says_as_much(
    parts: Parts, says: tuple[str, ...], twist: Twist
) -> None:
    assert order(parts, (), REACH, says) == twist


def test_rest_is_a_twist_of_zeros_whatever_the_robot_knows() -> None:
    for says in (STICK, TRUCK, BOAT, DRONE):
        assert order(Parts(), ("twist", "steer", "tilt"), REACH, says) == Twist()


@pytest.mark.parametrize(
    "said",
    [
        Manoeuvre(kind="steer", throttle=0.5, steering=0.1),
        Manoeuvre(kind="steer", speed=0.5, steering=0.1),
        Manoeuvre(kind="tilt", roll=0.1, pitch=-0.2, twist=Twist(Vector3(0.0, 0.0, 0.3))),
        Manoeuvre(kind="tilt", roll=0.1, pitch=-0.2, speed=0.3),
        Twist.planar(0.3, 0.1),
    ],
)
def test_what_one_control_says_comes_out_as_it_went_in(said: Drive) -> None:
    assert repr(order(Parts.of(said), ("twist", "steer", "tilt"), REACH, says_of(said))) == repr(said)


def says_of(said: Drive) -> tuple[str, ...]:
    kind = "" if isinstance(said, Twist) else said.kind
    return {"": STICK, "steer": TRUCK, "tilt": DRONE}[kind]


def test_every_change_of_any_control_is_sent_with_what_the_others_say() -> None:
    sent: list[Drive] = []
    piloting = ControlMixer(sent.append, lambda: ("twist", "tilt"), lambda: REACH, DRONE)
    piloting.set_parts("stick", Parts(climb=0.5))
    piloting.set_parts("circle", Parts(pitch=0.2))
    piloting.set_parts("stick", Parts())
    piloting.set_parts("circle", Parts())
    assert sent[0] == Twist(Vector3(0.0, 0.0, 0.5))
    assert (sent[1].pitch, sent[1].twist.linear.z) == (0.2, 0.5)
    assert (sent[2].pitch, sent[2].twist.linear.z) == (0.2, 0.0)
    assert sent[3] == Twist()


def test_a_control_that_says_what_is_no_number_counts_as_let_go() -> None:
    sent: list[Drive] = []
    piloting = ControlMixer(sent.append, tuple)
    piloting.set_parts("stick", Parts(ahead=0.5))
    piloting.set_parts("stick", Parts(ahead=math.nan, turn=1.0))
    assert sent[-1] == Twist()


def test_what_a_push_means_anew_is_sent_at_once_and_for_nothing_that_is_let_go() -> None:
    sent: list[Drive] = []
    piloting = ControlMixer(sent.append, tuple)
    piloting.set_parts("stick", Parts(ahead=2.0))
    piloting.retake({"stick": Parts(ahead=0.5), "lever": Parts(turn=1.0)})
    assert sent == [Twist.planar(2.0, 0.0), Twist.planar(0.5, 0.0)]
    piloting.set_parts("stick", Parts())
    piloting.retake({"stick": Parts(ahead=1.0)})
    assert sent[-1] == Twist(), "a control that is let go drives nothing, whatever it would mean"
    assert len(sent) == 3
