"""What a robot is not equipped with it offers no topic for."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from bridge.core.topics import TOPICS
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.bus import Bus
from robotside.door.offered_topics import OfferedTopics
from robotside.services.catalogue import catalogue
from robotside.station.station import Station
from sim.robot import ROBOTS, home_of, make
from tests.fakes import FakeRobot
from tests.robotside.scene import records_at

NAMES = {entry.name for entry in TOPICS}
MADE = {
    "/robot/info",
    "/pose",
    "/detections",
    "/intruders",
    "/localisation/candidates",
    "/plan",
    "/mission",
    "/task/status",
    "/task/progress",
    "/task/queue",
    "/control/status",
    "/schedule",
    "/places",
    "/limits",
    "/checklist",
    "/events",
    "/rosout",
    "/diagnostics",
    "/tf",
    "/sim/ground_truth",
    "/cmd_vel",
    "/cmd_manoeuvre",
    "/goal_pose",
    "/initialpose",
}
"""What a robot side has for any simulated robot with a camera, whatever else that is equipped with."""
CAMERA, REAR, DOWN = (f"/camera/{name}image/compressed" for name in ("", "rear/", "down/"))
ALL = {"/odom", "/imu/data", "/bumper", "/battery_state", "/motors", "/manoeuvre", "/map"} | {CAMERA}
EQUIPMENT = {
    "patrol": {"/scan", "/fix", "/joint_states", "/line_sensor"}
    | {f"/range/{side}" for side in ("front", "left", "right", "rear")},
    "scout": {"/sonar", "/joint_states"} | {f"/sonar/{number}" for number in range(16)},
    "commander": {"/scan", "/fix", "/joint_states", "/ackermann", REAR},
    "minnow": {"/fix", "/compass", "/rudder"},
    "aqua": {"/compass", "/depth", "/joint_states"},
    "ardrone": {"/flight", "/range/down", DOWN},
}


def offered(state: Path, name: str, *payloads: str) -> tuple[set[str], set[str]]:
    """The topics and services of a simulated robot."""
    robot = make(name, home_of([name]), payloads=payloads)
    station = Station(robot, records_at(state), now=0.0, clock=lambda: 0.0, rng=random.Random(1))
    offers = OfferedTopics(station.info, station.bus, simulated=station.robot.resettable)
    found = {topic for topic in NAMES if offers(topic)}, set(catalogue(station)[0])
    station.close()
    return found


def test_every_robot_has_equipment_of_its_own() -> None:
    assert set(EQUIPMENT) == set(ROBOTS)


@pytest.mark.parametrize("name", EQUIPMENT)
def test_a_robot_offers_the_topics_of_what_it_has_and_no_others(name: str, tmp_path: Path) -> None:
    topics, served = offered(tmp_path, name)
    assert topics == MADE | ALL | EQUIPMENT[name]
    assert not served & {"/arm/move", "/lights/set"}


def test_what_is_mounted_brings_its_topics_and_its_services(tmp_path: Path) -> None:
    bare, _ = offered(tmp_path / "bare", "patrol")
    carried = ("sonar", "camera", "lights", "tag_reader", "arm")
    topics, served = offered(tmp_path / "laden", "patrol", *carried)
    rings = {f"/sonar/{number}" for number in range(16)}
    assert topics - bare == {"/sonar", "/lights", "/tag", "/arm", REAR} | rings
    assert {"/arm/move", "/lights/set"} <= served


def test_one_that_sees_nothing_finds_nothing_and_a_real_one_knows_no_truth(tmp_path: Path) -> None:
    station = Station(FakeRobot(), records_at(tmp_path), now=0.0, clock=lambda: 0.0, rng=random.Random(1))
    offers = OfferedTopics(RobotInfo(), station.bus, simulated=False)
    assert not any(map(offers, (CAMERA, "/detections", "/sim/ground_truth")))
    station.close()


def test_what_comes_later_is_offered_from_then_on() -> None:
    bus = Bus()
    offers = OfferedTopics(RobotInfo(), bus, simulated=False)
    assert not offers("/tag")
    bus.publish("/tag", RobotInfo())
    assert offers("/tag")
