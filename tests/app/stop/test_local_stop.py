"""STOP of a robot without one: what the operator may be told of it."""

from __future__ import annotations

import math

import pytest

from app.stop.local_stop import LocalStop
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry


class Watch:
    """A STOP, a clock, and odometry at 20 Hz."""

    def __init__(self) -> None:
        self.time = 100.0
        self.stop = LocalStop(lambda: self.time)

    def drive(self, speed: float, seconds: float, turn: float = 0.0) -> None:
        for _ in range(round(seconds / 0.05)):
            self.time += 0.05
            twist = TwistWithCovariance(Twist.planar(speed, turn))
            self.stop.on_odometry(Odometry(twist=twist), self.time)


@pytest.fixture
def watch() -> Watch:
    return Watch()


def test_nothing_is_said_while_it_is_not_pressed(watch: Watch) -> None:
    watch.drive(0.0, 2.0)
    assert (watch.stop.phase, watch.stop.sentence(drives=True)) == ("ready", "")


def test_it_is_stopped_when_odometry_says_so_for_a_while(watch: Watch) -> None:
    watch.drive(0.5, 1.0)
    watch.stop.press()
    assert watch.stop.phase == "sent"
    watch.drive(0.2, 0.3)
    assert watch.stop.phase == "sent"
    watch.drive(0.0, 0.25)
    assert watch.stop.phase == "sent"
    watch.drive(0.0, 0.15)
    assert watch.stop.phase == "stopped"
    assert watch.stop.sentence(drives=True).endswith("Its odometry says that it rests.")


def test_a_robot_that_rested_before_has_to_say_so_again(watch: Watch) -> None:
    watch.drive(0.0, 2.0)
    watch.stop.press()
    assert watch.stop.phase == "sent"
    watch.drive(0.0, 0.4)
    assert watch.stop.phase == "stopped"


def test_one_that_goes_on_has_not_answered_and_is_said_to(watch: Watch) -> None:
    watch.stop.press()
    watch.drive(0.3, 1.2)
    assert watch.stop.phase == "no_answer"
    assert watch.stop.sentence(drives=True) == (
        "No STOP of its own: zero speed is sent while the link stands."
        " Its odometry does not yet say that it rests."
    )


@pytest.mark.parametrize("motion", [(0.05, 0.0), (0.0, 0.1), (math.nan, 0.0), (0.0, math.nan)])
def test_creeping_turning_and_unknown_speeds_confirm_nothing(
    watch: Watch, motion: tuple[float, float]
) -> None:
    watch.stop.press()
    watch.drive(motion[0], 2.0, motion[1])
    assert watch.stop.phase == "no_answer"


def test_what_was_stopped_and_moves_again_is_not_stopped(watch: Watch) -> None:
    watch.stop.press()
    watch.drive(0.0, 1.0)
    assert watch.stop.phase == "stopped"
    watch.drive(0.3, 0.1)
    assert watch.stop.phase == "no_answer"


def test_odometry_that_falls_silent_is_not_believed(watch: Watch) -> None:
    watch.stop.press()
    watch.drive(0.0, 1.5)
    watch.time += 1.1
    assert watch.stop.phase == "no_answer"
    assert watch.stop.sentence(drives=True).endswith("Its odometry was last heard 1 s ago.")
    watch.time += 118.9
    assert watch.stop.sentence(drives=True).endswith("Its odometry was last heard 2 min ago.")


def test_a_robot_that_never_told_odometry_is_said_to_have_none(watch: Watch) -> None:
    watch.stop.press()
    assert watch.stop.sentence(drives=True).endswith("No odometry has come that could confirm that it rests.")


def test_without_a_link_nothing_is_said_to_be_sent(watch: Watch) -> None:
    watch.stop.press()
    watch.drive(0.0, 1.0)
    watch.time += 12.0
    assert watch.stop.sentence(drives=True, reaches=False) == (
        "Nothing reaches it until the link is back. Its odometry was last heard 12 s ago."
    )


def test_a_robot_without_a_topic_to_drive_it_by_cannot_be_stopped_and_that_is_said(watch: Watch) -> None:
    watch.stop.press()
    assert "cannot be stopped from here" in watch.stop.sentence(drives=False)


def test_it_stays_latched_until_released(watch: Watch) -> None:
    watch.stop.press()
    watch.drive(0.0, 100.0)
    watch.stop.press()
    assert watch.stop.phase == "stopped"
    watch.stop.release()
    assert (watch.stop.latched, watch.stop.phase) == (False, "ready")


def test_rest_from_before_the_press_confirms_nothing(watch: Watch) -> None:
    """It stood for two seconds; a push that is still on its way may move it yet."""
    watch.drive(0.0, 2.0)
    watch.stop.press()
    watch.drive(0.0, 0.25)
    assert watch.stop.phase == "sent"
    watch.drive(0.0, 0.15)
    assert watch.stop.phase == "stopped"


def test_odometry_that_was_received_before_the_press_does_not_begin_the_rest(watch: Watch) -> None:
    watch.stop.press()
    twist = TwistWithCovariance(Twist.planar(0.0, 0.0))
    watch.stop.on_odometry(Odometry(twist=twist), watch.time - 0.4)
    watch.drive(0.0, 0.1)
    assert watch.stop.phase == "sent"
