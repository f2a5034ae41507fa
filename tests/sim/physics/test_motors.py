"""Motors warm by what they lose and cool towards the air, as the heat balance written out on paper has it."""

from __future__ import annotations

import math

import pytest

from sim.physics.motors import AMBIENT_TEMPERATURE, MotorParameters, Motors

MAKE = MotorParameters(efficiency=0.8, copper=2.0, heat_capacity=50.0, cooling=0.5)
TIME_CONSTANT = 50.0 / 0.5
"""Of a motor of that make [s]."""
STEP = 0.01


def worked(seconds: float, speed: float, torque: float, start: float = AMBIENT_TEMPERATURE) -> Motors:
    """One motor after so long at `speed` against `torque`."""
    motors = Motors(MAKE, ["left"])
    motors.temperatures[0] = start
    for _ in range(round(seconds / STEP)):
        motors.work([speed], [torque], STEP)
    return motors


@pytest.mark.parametrize("start", [70.0, -30.0])
def test_at_rest_it_comes_to_the_temperature_round_it_and_never_beyond(start: float) -> None:
    for constants in (0.5, 1.0, 8.0):
        motors = worked(constants * TIME_CONSTANT, 0.0, 0.0, start)
        left = (start - AMBIENT_TEMPERATURE) * math.exp(-constants)
        assert motors.temperatures[0] - AMBIENT_TEMPERATURE == pytest.approx(left, rel=1e-3)


def test_at_work_it_warms_until_it_gives_off_what_it_loses() -> None:
    """3 N m cost 18 W in the winding; 12 W at the shaft take 15 W at an efficiency of 0.8, so 21 W are lost: 42 K at 0.5 W/K."""
    motors = worked(10 * TIME_CONSTANT, 4.0, 3.0)
    assert motors.temperatures[0] == pytest.approx(AMBIENT_TEMPERATURE + 42.0, abs=0.01)
    assert motors.work([4.0], [3.0], STEP) == pytest.approx(12.0 + 21.0)


def test_what_drives_it_costs_the_winding_and_gives_nothing_back() -> None:
    motors = Motors(MAKE, ["left", "right"])
    assert motors.work([4.0, -4.0], [-3.0, 3.0], STEP) == pytest.approx(2 * 18.0)
    assert motors.work([-4.0], [-3.0], STEP) == pytest.approx(33.0), "backwards it works like forwards"


def test_each_warms_by_its_own_work() -> None:
    motors = Motors(MAKE, ["left", "right"])
    motors.work([0.0, 0.0], [3.0, 0.0], 1.0)
    assert motors.temperatures == pytest.approx([AMBIENT_TEMPERATURE + 18.0 / 50.0, AMBIENT_TEMPERATURE])
    message = motors.message(2.5)
    assert (list(message.torques), message.header.stamp.seconds) == ([3.0, 0.0], 2.5)
