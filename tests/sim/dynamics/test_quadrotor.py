"""Four rotors: what is asked of them is what they give, and at their end the thrust goes before the yaw."""

from __future__ import annotations

import math

import numpy as np
import pytest

from sim.core.constants import STEPS_PER_SECOND
from sim.core.shapes import Vec3
from sim.dynamics.quadrotor import ROTORS, RotorParameters, Rotors

ARM, LIFT, DRAG, MAX_SPEED, LAG = 0.2, 1e-5, 2e-7, 600.0, 0.05
STRONGEST = LIFT * MAX_SPEED**2
"""Lift of one rotor at its fastest [N]."""
PLACES = {
    "front_left": (1, 1),
    "front_right": (1, -1),
    "rear_right": (-1, -1),
    "rear_left": (-1, 1),
}


@pytest.fixture
def rotors() -> Rotors:
    return Rotors(
        RotorParameters(arm=ARM, lift=LIFT, torque=DRAG, lag=LAG, speed=MAX_SPEED, gear=8.0),
    )


def given(rotors: Rotors, thrust: float, torque: Vec3) -> tuple[float, Vec3]:
    """What they give once they turn as fast as they were told."""
    rotors.command(thrust, torque)
    for _ in range(round(20 * LAG * STEPS_PER_SECOND)):
        rotors.step()
    return rotors.step()


def summed(rotors: Rotors) -> tuple[float, list[float]]:
    """Thrust and torque by the lifts at the ends of the arms, r x F of each, and by the drag of each."""
    reach = ARM / math.sqrt(2)
    lifts = [LIFT * speed**2 for speed in rotors.speeds]
    ends = np.array([(x * reach, y * reach, 0.0) for x, y in (PLACES[name] for name in ROTORS)])
    torque = np.cross(ends, [(0.0, 0.0, lift) for lift in lifts]).sum(axis=0)
    turns = [-1 if PLACES[name][0] == PLACES[name][1] else 1 for name in ROTORS]
    torque[2] = sum(turn * drag for turn, drag in zip(turns, rotors.torques, strict=True))
    return sum(lifts), torque.tolist()


@pytest.mark.parametrize(
    "torque", [(0.05, 0.0, 0.0), (0.0, 0.05, 0.0), (0.0, 0.0, 0.01), (-0.04, 0.03, -0.008)]
)
def test_within_their_reach_they_give_what_they_are_asked_for(rotors: Rotors, torque: Vec3) -> None:
    lifted, turned = given(rotors, 6.0, torque)
    assert lifted == pytest.approx(6.0)
    assert turned == pytest.approx(torque, abs=1e-9)
    assert (lifted, turned) == (pytest.approx(summed(rotors)[0]), pytest.approx(summed(rotors)[1], abs=1e-9))


@pytest.mark.parametrize("thrust", [0.2, 3.0, 0.97 * 4 * STRONGEST])
@pytest.mark.parametrize("yaw", [-5.0, 5.0])
def test_a_yaw_that_they_cannot_give_takes_nothing_of_thrust_roll_and_pitch(
    rotors: Rotors, thrust: float, yaw: float
) -> None:
    tilt = 0.002
    lifted, turned = given(rotors, thrust, (tilt, -tilt, yaw))
    assert lifted == pytest.approx(thrust)
    assert turned[:2] == pytest.approx((tilt, -tilt))
    assert turned[2] * yaw > 0, "what is left over of them turns it, and the right way"


def test_no_rotor_turns_backwards_or_faster_than_it_can(rotors: Rotors) -> None:
    for thrust in (0.0, 3.0, 100.0):
        rotors.command(thrust, (3.0, -3.0, 3.0))
        assert all(0.0 <= target <= MAX_SPEED * (1 + 1e-9) for target in rotors.targets)


def test_told_to_stop_they_run_down_by_their_lag(rotors: Rotors) -> None:
    given(rotors, 6.0, (0.0, 0.0, 0.0))
    before = list(rotors.speeds)
    rotors.stop()
    for _ in range(round(LAG * STEPS_PER_SECOND)):
        rotors.step()
    assert rotors.speeds == pytest.approx([speed / math.e for speed in before], rel=1e-6)
