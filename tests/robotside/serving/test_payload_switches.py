"""Switching payloads: what safety needs stays on, what is in use stays on, and what is off is not there and takes no power."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import (
    CommandResponse,
    Event,
    LightState,
    Payload,
    PayloadArray,
    SetLightsRequest,
    SetPayloadRequest,
    SonarRing,
    TagRead,
    Waypoint,
)
from bridge.msgs.sensor_msgs import CompressedImage, Imu, NavSatFix
from robotside.gateways.payloads.offered import offered
from robotside.serving.payload_switches import PayloadSwitches
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.hand import Hand
from tests.robotside.scene import Scene


class LadenRobot(FakeRobot):
    """A robot with a camera, lights, an arm and a ring of sonars, whose sensors have switches."""

    def __init__(self) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, payloads=["arm", "lights"], cameras=["front"])
        self.more = [("/lights", LightState(brightness=1.0)), ("/sonar", SonarRing()), ("/imu/data", Imu())]
        self.more += [("/fix", NavSatFix()), ("/tag", TagRead(tag="7"))]
        self.orders: list[tuple[str, Msg]] = []
        self.held = 0
        self.switched: dict[str, bool] = {}

    def switch(self, topic: str, on: bool) -> None:
        self.switched[topic] = on

    def command(self, payload: str, order: Msg) -> None:
        self.orders.append((payload, order))

    def hold_payloads(self) -> None:
        self.held += 1


class Switches:
    """A station with switches, and a listener to them."""

    def __init__(self, robot: FakeRobot, state: Path) -> None:
        self.robot = robot
        self.scene = Scene(robot, state)
        self.changes = 0
        self.switches = PayloadSwitches(self.scene.door, self.scene.station, self._change)
        self.heard: list[PayloadArray] = []
        self.scene.run(3.2)  # it knows where it is

    def _change(self) -> None:
        self.changes += 1

    def listen(self) -> None:
        self.scene.door.subscribe(self, "/payloads", lambda _, msg: self.heard.append(msg))  # type: ignore[arg-type]

    def of(self, key: str) -> Payload:
        return next(each for each in self.heard[-1].payloads if each.key == key)

    def set(self, key: str, on: bool, client: FakeClient | None = None) -> CommandResponse:
        return self.scene.ask("/payloads/set", SetPayloadRequest(key=key, on=on), client)

    def refused(self, key: str) -> tuple[str, str]:
        answer = self.set(key, False)
        assert not answer.success, answer.message
        return answer.code, answer.message


@pytest.fixture
def run(tmp_path: Path) -> Switches:
    return Switches(LadenRobot(), tmp_path)


def test_what_safety_needs_is_never_switched_off(run: Switches) -> None:
    run.listen()
    for key, why in (
        ("robot", "STOP and control are always there"),
        ("tasks", "ends a task has to be at hand"),
        ("laser", "keeps the robot off obstacles"),
        ("bumper", "stops the robot where it touches"),
        ("imu", "how the robot leans"),
    ):
        code, said = run.refused(key)
        assert code == "payload_fixed", key
        assert why in said
        assert (run.of(key).on, run.of(key).fixed) == (True, True), key
        assert why in run.of(key).why
    assert isinstance(run.robot, LadenRobot)
    assert not run.robot.switched


def test_without_a_laser_sonars_and_satellites_are_needed(tmp_path: Path) -> None:
    robot = LadenRobot()
    robot.silent = {"/scan"}
    run = Switches(robot, tmp_path)
    assert "sonars keep the robot off obstacles" in run.refused("sonar")[1]
    assert "satellites tell where the robot is" in run.refused("satellite")[1]
    assert not robot.switched


def test_with_a_laser_they_are_not(run: Switches) -> None:
    assert run.set("sonar", False).success
    assert run.set("satellite", False).success


@pytest.mark.parametrize(("name", "key"), [("aqua", "depth"), ("ardrone", "ranges"), ("minnow", "compass")])
def test_what_tells_where_a_robot_is_that_flies_dives_or_floats_stays_on(
    name: str, key: str, tmp_path: Path
) -> None:
    hand = Hand(name, tmp_path)
    try:
        PayloadSwitches(hand.door, hand.station, lambda: None)
        answer = hand.door.call(hand.anna, "/payloads/set", SetPayloadRequest(key=key, on=False))
        assert isinstance(answer, CommandResponse)
        assert (answer.success, answer.code) == (False, "payload_fixed")
    finally:
        hand.close()


def test_nothing_is_switched_off_while_a_task_is_under_way(run: Switches) -> None:
    run.scene.set(Waypoint(3.0, 0.0))
    run.scene.start()
    assert run.refused("camera")[0] == "task_active"
    run.scene.ask("/task/pause")
    assert run.refused("camera")[0] == "task_active"
    run.scene.ask("/task/cancel")
    assert run.set("camera", False).success


def test_nothing_is_switched_off_under_a_driver(run: Switches) -> None:
    other = run.scene.client("other")
    run.scene.ask("/control/acquire", client=other)
    assert run.refused("camera")[0].startswith("control_held")
    run.scene.ask("/control/release", client=other)
    for _ in range(30):
        run.scene.drive(Twist(Vector3(0.3)), stamp=run.scene.clock)
        run.scene.run(1 / 30)
    code, said = run.refused("camera")
    assert code == "payload_in_use"
    assert "until it stands" in said
    run.scene.run(1.5)
    assert run.scene.station.controls.holds(run.scene.anna), "who has control and stands still may"
    assert run.set("camera", False).success


def test_switching_on_is_always_possible(run: Switches) -> None:
    assert run.set("camera", False).success
    run.scene.set(Waypoint(3.0, 0.0))
    run.scene.start()
    assert run.set("camera", True).success
    assert run.robot.wanted == {CAMERA: True}, "the task watches from now on"


def test_only_who_manages_the_robot_switches(run: Switches) -> None:
    driver = run.scene.client("driver")
    driver.identity = Identity("d", "driver", Role.DRIVE)
    with pytest.raises(Refused, match="needs the role manage"):
        run.set("camera", False, driver)


def test_a_camera_that_is_off_takes_no_picture_whoever_wants_one(run: Switches) -> None:
    door, robot = run.scene.door, run.robot
    seen: list[Msg] = []
    door.subscribe("viewer", CAMERA, lambda _, msg: seen.append(msg))
    assert robot.wanted == {CAMERA: True}
    assert run.set("camera", False).success
    assert robot.wanted == {CAMERA: False}
    door.subscribe("another", CAMERA, lambda _, msg: seen.append(msg))
    run.scene.set(Waypoint(3.0, 0.0))
    run.scene.start()
    assert robot.wanted == {CAMERA: False}, "a task does not switch it on"
    robot.more.append((CAMERA, CompressedImage()))
    run.scene.run(0.1)
    assert not seen
    assert not door.offers(CAMERA)
    for verb, name in (("subscribe", CAMERA), ("subscribe", "/detections"), ("camera", "front")):
        with pytest.raises(Refused, match="camera is switched off") as refused:
            door.check(run.scene.anna, verb, name)
        assert refused.value.args[0].code == "payload_off"
    assert run.set("camera", True).success
    assert robot.wanted == {CAMERA: True}
    robot.more.append((CAMERA, CompressedImage()))
    run.scene.run(0.1)
    assert len(seen) == 2, "each of the viewers goes on to see"
    door.check(run.scene.anna, "camera", "front")


def test_lights_go_dark_and_take_no_order(run: Switches) -> None:
    robot, door = run.robot, run.scene.door
    assert isinstance(robot, LadenRobot)
    assert run.set("lights", False).success
    assert robot.orders == [("lights", LightState(brightness=0.0))]
    with pytest.raises(Refused, match="/lights/set is not there: lights is switched off"):
        run.scene.ask("/lights/set", SetLightsRequest(brightness=1.0))
    assert robot.orders == [("lights", LightState(brightness=0.0))]
    assert robot.switched == {"/lights": False}
    assert not any(each.payload.key == "lights" for each in offered(door))
    assert run.set("lights", True).success
    assert run.scene.ask("/lights/set", SetLightsRequest(brightness=1.0)).success
    assert robot.switched == {"/lights": True}


def test_an_arm_stays_where_it_is(run: Switches) -> None:
    assert isinstance(run.robot, LadenRobot)
    run.robot.more.append(("/arm", Msg()))
    run.scene.run(0.1)
    assert run.set("arm", False).success
    assert run.robot.held == 1


def test_the_robot_knows_how_it_moves_though_nobody_is_told(run: Switches) -> None:
    assert isinstance(run.robot, LadenRobot)
    assert run.set("wheels", False).success
    assert not run.robot.switched
    heard: list[Msg] = []
    run.scene.door.subscribe("viewer", "/odom", lambda _, msg: heard.append(msg))
    run.scene.run(1.0)
    assert not heard
    with pytest.raises(Refused, match="wheels is switched off"):
        run.scene.drive(Twist(Vector3(0.3)), stamp=run.scene.clock)
    assert run.scene.station.at_rest
    assert run.scene.ask("/stop").success, "STOP is pressed whatever is off"


def test_nobody_waits_for_a_sensor_that_is_off(run: Switches) -> None:
    run.scene.run(2.0)
    health = run.scene.station.readiness.sensor_health
    assert "sonars" in health.silent(run.scene.now)
    run.set("sonar", False)
    assert "sonars" not in health.silent(run.scene.now)


def test_a_latched_message_is_sent_again_when_it_is_on_again(run: Switches) -> None:
    tags: list[TagRead] = []
    run.scene.door.subscribe("viewer", "/tag", lambda _, msg: tags.append(msg))  # type: ignore[arg-type]
    run.set("tag", False)
    run.robot.more.append(("/tag", TagRead(tag="8")))
    run.scene.run(0.1)
    assert [each.tag for each in tags] == ["7"]
    run.set("tag", True)
    assert [each.tag for each in tags] == ["7", "8"]


def test_the_list_says_what_is_on_what_it_has_and_who_switched_it_off(run: Switches) -> None:
    run.listen()
    name = run.scene.station.controls.name(run.scene.anna)
    lights = run.of("lights")
    assert (lights.on, lights.fixed, lights.why) == (True, False, "")
    assert (lights.topics, lights.services) == (["/lights"], ["/lights/set"])
    assert "depth" not in {each.key for each in run.heard[-1].payloads}, "what it has not is not listed"
    order = [each.key for each in run.heard[-1].payloads]
    run.set("lights", False)
    lights = run.of("lights")
    assert (lights.on, lights.why) == (False, f"{name} switched lights off.")
    assert lights.topics == ["/lights"]
    assert [each.key for each in run.heard[-1].payloads] == order
    assert run.changes == 1
    assert run.set("lights", False).message == "Lights is off already."
    assert run.changes == 1
    event = run.scene.of("/events")[-1]
    assert isinstance(event, Event)
    assert (event.code, event.text) == ("payload_switched", f"{name} switched lights off.")


def test_what_the_robot_has_not_is_refused_with_what_it_has(run: Switches) -> None:
    for key in ("wings", "depth"):
        code, said = run.refused(key)
        assert code == "payload_unknown"
        assert "it has robot, wheels" in said


def test_nobody_makes_the_list_before_somebody_asks(run: Switches) -> None:
    run.scene.run(1.0)
    run.set("lights", False)
    assert run.scene.station.bus.last("/payloads") is None


def test_a_simulated_sonar_that_is_off_is_not_measured(tmp_path: Path) -> None:
    hand = Hand("patrol", tmp_path, payloads=["sonar"])
    try:
        PayloadSwitches(hand.door, hand.station, lambda: None)
        rings: list[Msg] = []
        hand.station.bus.subscribe("/sonar", lambda _, msg: rings.append(msg), replay=False)
        for on, least in ((False, 0), (True, 5)):
            answer = hand.door.call(hand.anna, "/payloads/set", SetPayloadRequest(key="sonar", on=on))
            assert isinstance(answer, CommandResponse)
            assert answer.success, answer.message
            hand.wait(0.3)
            rings.clear()
            hand.wait(1.0)
            assert (len(rings) >= least) if on else not rings
    finally:
        hand.close()
