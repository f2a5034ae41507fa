"""A robot side in front of a robot that is out of reach for a while, in virtual time: STOP, rest and a held stick."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.client.connection import Connection
from bridge.msgs.geometry_msgs import PoseWithCovariance, Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry
from robotside.control.neutral_interlock import LET_GO_SENTENCE
from robotside.foreign.foreign_link import Listener
from robotside.foreign.foreign_robot import SILENT_SENTENCE, ForeignRobot
from robotside.foreign.foreign_topics import Found
from tests.bridge.client.foreign_server import foreign
from tests.robotside.foreign.test_foreign_link import reached, until
from tests.robotside.scene import Scene

AHEAD, REST = Twist.planar(0.3, 0.0), Twist()
CUT = "Nothing came from robot:9090 for 3 s."
FOUND = Found({"/odom": ("/odom", Odometry)})


class Far:
    """A robot that keeps its last command for ever, at the end of a line that can freeze or be cut."""

    def __init__(self) -> None:
        self.silent = self.dropped = self.frozen = False
        self.speed = 0.0
        self.heard: list[Twist] = []
        self._waiting: list[Twist] = []

    def __call__(self, url: str, listener: Listener) -> Far:
        self.listener = listener
        listener.on_found(FOUND)
        return self

    def robot_time(self) -> float:
        return math.nan

    def drive(self, twist: Twist) -> None:
        self._waiting.append(twist)

    def press_stop(self) -> None:
        pass

    def release_stop(self) -> None:
        pass

    def want(self, topic: str, wanted: bool) -> None:
        pass

    def close(self) -> None:
        pass

    def move(self) -> None:
        """Obey what has arrived and tell how fast it is."""
        if self.frozen:
            return
        for twist in self._waiting:
            self.heard.append(twist)
            self.speed = twist.linear.x
        self._waiting.clear()
        speed = TwistWithCovariance(Twist.planar(self.speed, 0.0))
        self.listener.on_message("/odom", Odometry(pose=PoseWithCovariance(), twist=speed))

    def freeze(self) -> None:
        self.frozen = True

    def lose(self) -> None:
        self.silent = False
        self._waiting.clear()
        self.listener.on_lost(CUT)

    def come_back(self) -> None:
        self.frozen = False
        self.listener.on_found(FOUND)


class Outage:
    """A scene in which the stick is held or not."""

    def __init__(self, state: Path) -> None:
        self.far = Far()
        self.scene = Scene(ForeignRobot("ws://robot:9090", patience=0.0, connect=self.far), state)  # type: ignore[arg-type]

    def run(self, seconds: float, stick: Twist | None = None) -> None:
        for _ in range(round(seconds / 0.05)):
            if stick is not None:
                self.scene.drive(stick, stamp=self.scene.clock)
            self.far.move()
            self.scene.run(0.05)


@pytest.fixture
def outage(tmp_path: Path) -> Iterator[Outage]:
    made = Outage(tmp_path)
    made.run(2.0)
    made.run(1.0, AHEAD)
    assert made.far.speed == 0.3
    yield made
    made.scene.station.close()


def test_it_rests_when_its_odometry_says_so_and_drives_when_it_does_not(outage: Outage) -> None:
    assert not outage.scene.control.at_rest
    outage.run(0.5, REST)
    assert outage.scene.control.at_rest
    outage.run(1.6, Twist.planar(-0.3, 0.0))
    assert outage.far.speed == -0.3
    assert not outage.scene.control.at_rest


def test_stop_is_not_done_before_the_robot_is_back_and_says_itself_that_it_rests(outage: Outage) -> None:
    outage.far.freeze()
    outage.run(1.0, AHEAD)
    outage.far.silent = True
    outage.run(0.3)
    assert outage.scene.refused("/stop") == f"STOP is pressed, but t{SILENT_SENTENCE[1:]}"
    outage.run(2.0)
    outage.far.lose()
    outage.run(3.0)
    said = f"STOP is pressed, but the robot cannot be reached: n{CUT[1:]}"
    assert outage.scene.refused("/stop") == said
    assert (outage.scene.control.stopped, outage.scene.control.at_rest) == (True, False)
    before = len(outage.far.heard)
    outage.far.come_back()
    assert outage.scene.ask("/stop").message == "Stopped."
    assert not outage.scene.control.at_rest
    outage.run(0.3)
    assert set(outage.far.heard[before:]) == {REST}
    assert outage.scene.control.at_rest


@pytest.mark.parametrize("lost", [False, True], ids=["silent for two seconds", "lost"])
def test_a_held_stick_does_not_drive_the_robot_off_when_it_is_back(outage: Outage, lost: bool) -> None:
    outage.far.freeze()
    outage.run(1.0, AHEAD)
    outage.far.silent = True
    outage.run(1.0, AHEAD)
    if lost:
        outage.far.lose()
        outage.run(5.0, AHEAD)
        outage.far.come_back()
    outage.far.silent = outage.far.frozen = False
    outage.run(0.5, AHEAD)
    assert outage.far.heard[-1] == REST
    outage.run(3.0, AHEAD)
    assert (outage.far.heard[-1], outage.far.speed) == (REST, 0.0)
    assert outage.scene.events("command")[-1] == LET_GO_SENTENCE
    outage.scene.drive(REST)
    outage.run(0.2, AHEAD)
    assert outage.far.speed == 0.3


def test_a_silent_robot_is_told_of_soon_and_again_when_it_speaks(outage: Outage) -> None:
    outage.far.freeze()
    outage.far.silent = True
    outage.run(0.3)
    assert outage.scene.events("robot")[-1] == SILENT_SENTENCE
    outage.far.silent = outage.far.frozen = False
    outage.run(0.1)
    assert outage.scene.events("robot")[-1] == "The robot can be driven again; it stands still."
    outage.run(0.2)
    assert outage.far.heard[-1] == REST


def test_a_silence_of_a_moment_is_none(outage: Outage) -> None:
    outage.far.silent = True
    outage.run(0.1, AHEAD)
    outage.far.silent = False
    outage.run(0.5, AHEAD)
    assert outage.scene.events("robot") == []
    assert outage.far.speed == 0.3


async def test_over_a_line_that_is_stuck_rest_goes_out_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    async with foreign() as server, reached(server.port) as robot:
        robot.drive(AHEAD)
        await until(lambda: server.robot.speed == 0.3)
        monkeypatch.setattr(Connection, "stuck", True)
        before = server.robot.heard
        robot.drive(AHEAD)
        robot.stop()
        await until(lambda: server.robot.heard > before)
        assert server.robot.speed == 0.0
