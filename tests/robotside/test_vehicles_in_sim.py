"""Every simulated robot behind the robot side: it is driven by a stick, and left alone it takes the safe state of its kind."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import CommandRequest, Manoeuvre
from robotside.core.pose2 import Pose2
from sim.robot import SimRobot, make
from tests.robotside.sim_run import Run

pytestmark = pytest.mark.slow

WORLDS = {
    "patrol": "parking_lot",
    "scout": "parking_lot",
    "commander": "parking_lot",
    "minnow": "lake",
    "aqua": "tank",
    "ardrone": "parking_lot",
}


class Hand(Run):
    """A stick in somebody's hand."""

    def __init__(self, robot: SimRobot, state: Path) -> None:
        super().__init__(robot, state)
        self.said = 0

    def push(self, twist: Twist, seconds: float) -> None:
        """Hold the stick there."""
        for _ in range(round(seconds * 20)):
            self.station.on_message(self.anna, "/cmd_vel", twist, None)
            self.wait(0.05)

    @property
    def where(self) -> tuple[float, float, float]:
        x, y, z = self.robot.simulation.vehicle.state().position
        return x, y, z


def hand(name: str, state: Path) -> Hand:
    """Of a robot that can be driven: one that flies is in the air."""
    run = Hand(make(name, WORLDS[name], seed=2, camera=False), state)
    if name == "ardrone":
        run.robot.manoeuvre(Manoeuvre(kind="take_off"))
        run.wait(2.5)
    return run


@pytest.mark.parametrize("name", WORLDS)
def test_a_stick_drives_it_and_stop_brings_it_to_rest(name: str, tmp_path: Path) -> None:
    run = hand(name, tmp_path)
    start = run.where
    run.push(Twist(Vector3(0.4, 0.0, 0.3 if name == "ardrone" else 0.0)), 5.0)
    assert math.dist(start, run.where) > 0.8
    run.ask("/stop", CommandRequest())
    run.push(Twist(Vector3(0.4, 0.0, 0.0)), 6.0)
    before = run.where
    run.push(Twist(Vector3(0.4, 0.0, 0.0)), 2.0)
    stirred = math.dist(before, run.where) / 2.0
    run.robot.close()
    # a boat drifts with current and wind, a swimmer rises by its spare buoyancy
    assert stirred < {"minnow": 0.25, "aqua": 0.12}.get(name, 0.02)


def test_a_truck_knows_where_it_is_though_its_laser_is_on_its_bumper(tmp_path: Path) -> None:
    run = hand("commander", tmp_path)
    run.push(Twist.planar(1.0, -0.15), 6.0)
    error = run.error
    run.robot.close()
    assert error < 0.1


def test_a_drone_that_nobody_drives_hovers_and_lands(tmp_path: Path) -> None:
    run = hand("ardrone", tmp_path)
    run.push(Twist(Vector3(0.0, 0.0, 0.4)), 5.0)
    run.wait(3.0)
    height = run.where[2]
    run.wait(4.0)
    assert height > 1.0
    assert run.where[2] == pytest.approx(height, abs=0.15)
    for _ in range(60 * 40):  # nobody is heard any more
        run.now += 1 / 60
        run.station.step(run.now)
    landed, motors = run.where[2], run.robot.simulation.vehicle.motors.speeds  # type: ignore[attr-defined]  # its rotors
    run.robot.close()
    assert landed < 0.08
    assert max(motors) < 1.0


def test_a_swimmer_that_nobody_drives_holds_its_depth(tmp_path: Path) -> None:
    run = hand("aqua", tmp_path)
    run.push(Twist(Vector3(0.3, 0.0, -0.2)), 6.0)
    run.wait(4.0)
    depth = run.where[2]
    run.wait(8.0)
    drifted = abs(run.where[2] - depth)
    run.robot.close()
    assert depth < -1.4
    assert drifted < 0.1


@pytest.mark.parametrize(
    ("name", "near"), [("scout", 0.15), ("minnow", 2.0), ("aqua", 0.4), ("ardrone", 0.6)]
)
def test_one_without_a_laser_tells_where_it_is_by_satellite_or_by_its_own_reckoning(
    name: str, near: float, tmp_path: Path
) -> None:
    run = hand(name, tmp_path)
    run.push(Twist(Vector3(0.4, 0.0, 0.3 if name == "ardrone" else 0.0), Vector3(0.0, 0.0, -0.1)), 12.0)
    error, sure = run.error, run.station.autonomy.pose_estimator.sure
    run.robot.close()
    assert error < near
    assert sure


def test_a_boat_does_not_stray_from_its_satellite_fixes(tmp_path: Path) -> None:
    run = hand("minnow", tmp_path)
    x, y, yaw = run.robot.simulation.pose()
    run.station.autonomy.pose_estimator.place(Pose2(x + 6.0, y, yaw))
    run.wait(30.0)
    error, pose = run.error, run.station.autonomy.pose_estimator.pose
    run.robot.close()
    assert error < 3.0
    assert pose is not None
    assert [type(part) for part in pose] == [float, float, float]  # numpy's have no form on the wire
