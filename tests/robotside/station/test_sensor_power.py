"""Power of sensors: what is off is not measured, whoever wants it, and is again when it is on."""

from __future__ import annotations

from robotside.station.sensor_power import SensorPower
from tests.fakes import FakeRobot


class SwitchedRobot(FakeRobot):
    """A robot whose sensors can be switched off."""

    def __init__(self) -> None:
        super().__init__()
        self.switched: list[tuple[str, bool]] = []

    def switch(self, topic: str, on: bool) -> None:
        self.switched.append((topic, on))


def test_what_is_off_is_not_made_for_who_wants_it_and_is_when_it_is_on_again() -> None:
    robot = SwitchedRobot()
    power = SensorPower(robot, lambda _: None)
    power.want("/picture", True)
    power.switch(["/picture"], False)
    assert robot.wanted == {"/picture": False}
    power.switch(["/picture"], True)
    assert robot.wanted == {"/picture": True}


def test_who_comes_while_it_is_off_gets_it_when_it_is_on_and_who_left_does_not() -> None:
    robot = SwitchedRobot()
    power = SensorPower(robot, lambda _: None)
    power.want("/left", True)
    power.switch(["/came", "/left"], False)
    power.want("/came", True)
    power.want("/left", False)
    assert "/came" not in robot.wanted
    power.switch(["/came", "/left"], True)
    assert robot.wanted == {"/came": True, "/left": False}


def test_the_sensor_itself_is_switched_once_and_nobody_waits_for_it() -> None:
    robot, forgotten = SwitchedRobot(), list[str]()
    power = SensorPower(robot, forgotten.append)
    for on in (False, False, True, True):
        power.switch(["/sonar"], on)
    assert robot.switched == [("/sonar", False), ("/sonar", True)]
    assert forgotten == ["/sonar"]


def test_a_robot_whose_sensors_have_no_switch_is_only_not_asked_for_them() -> None:
    robot = FakeRobot()
    power = SensorPower(robot, lambda _: None)
    power.want("/picture", True)
    power.switch(["/picture", "/sonar"], False)
    assert robot.wanted == {"/picture": False}
