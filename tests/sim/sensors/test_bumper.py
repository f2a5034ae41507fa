"""The bumper ring: where it was hit, how long it stays pressed, and what counts as another bump."""

from __future__ import annotations

import math

import pytest

from sim.core.shapes import Vec3, from_yaw, rotate
from sim.physics.bodies import Contact, State
from sim.sensors.bumper import HOLD_STEPS, SEPARATE_STEPS, BumperRing

AT: Vec3 = (3.0, -2.0, 0.1)


def standing(yaw: float = 0.0) -> State:
    return State(AT, from_yaw(yaw), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


def hit(bearing: float, yaw: float = 0.0, body: int = 1) -> Contact:
    """A contact on the ring of a robot at `AT`, at that bearing of its own."""
    ahead, left, _ = rotate(from_yaw(yaw), (0.3 * math.cos(bearing), 0.3 * math.sin(bearing), 0.0))
    return Contact(body, (AT[0] + ahead, AT[1] + left, AT[2]))


@pytest.mark.parametrize("yaw", [0.0, 2.0])
@pytest.mark.parametrize("bearing", [0.0, math.pi / 2, -math.pi / 2, 2.5])
def test_a_bump_on_the_left_has_a_positive_bearing_however_the_robot_stands(
    bearing: float, yaw: float
) -> None:
    ring = BumperRing()
    ring.update(1, [hit(bearing, yaw)], standing(yaw))
    message = ring.message(0.0)
    assert (message.pressed, message.bearing) == (True, pytest.approx(bearing))


def test_it_stays_pressed_while_a_wall_chatters_and_is_released_after_it() -> None:
    ring = BumperRing()
    ring.update(1, [hit(0.0)], standing())
    assert ring.changed
    ring.message(0.0)
    ring.update(1 + HOLD_STEPS, [], None)
    assert (ring.message(0.0).pressed, ring.changed) == (True, False)
    ring.update(2 + HOLD_STEPS, [], None)
    assert ring.changed
    assert (ring.message(0.0).pressed, math.isnan(ring.message(0.0).bearing)) == (False, True)


def test_the_same_thing_is_bumped_again_only_after_a_while_and_another_one_at_once() -> None:
    ring = BumperRing()
    for step in (1, 2, SEPARATE_STEPS):
        ring.update(step, [hit(0.0)], standing())
    assert ring.bumps == 1
    ring.update(2 * SEPARATE_STEPS, [hit(0.0)], standing())
    assert ring.bumps == 2
    ring.update(2 * SEPARATE_STEPS, [hit(0.5, body=2)], standing())
    assert ring.bumps == 3
