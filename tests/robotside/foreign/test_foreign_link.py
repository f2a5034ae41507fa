"""The robot side on a server that is not ours, and on a robot side of ours behind a wire that is cut."""

from __future__ import annotations

import asyncio
import random
import time
from collections.abc import AsyncIterator, Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager
from functools import partial
from pathlib import Path

import pytest

from bridge.client.client import BridgeClient
from bridge.core.address import BadAddress
from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    Event,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    Waypoint,
)
from robotside.core.clock import RobotClock
from robotside.core.pose2 import ORIGIN
from robotside.core.robot import Robot
from robotside.foreign.foreign_link import ForeignLink
from robotside.foreign.foreign_robot import ForeignRobot
from robotside.foreign.foreign_topics import Found
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from tests.bridge.client.foreign_server import ForeignServer, foreign
from tests.bridge.wires import wire
from tests.fakes import FakeRobot
from tests.releasing import release_stop
from tests.robotside.scene import records_at
from tests.robotside.serving.test_station_server import connected

SPEED = Twist.planar(0.3, 0.1)


async def until(true: Callable[[], object]) -> None:
    """Until it is true; it becomes so in another thread."""
    async with asyncio.timeout(60):
        while not true():  # noqa: ASYNC110 - no event reaches over
            await asyncio.sleep(0.01)


@asynccontextmanager
async def reached(port: int) -> AsyncIterator[ForeignRobot]:
    loop = asyncio.get_running_loop()
    with ThreadPoolExecutor(1) as aside:
        robot = await loop.run_in_executor(aside, ForeignRobot, f"ws://127.0.0.1:{port}")
        try:
            yield robot
        finally:
            await loop.run_in_executor(aside, robot.close)


class Reads:
    """Everything that was read of a robot."""

    def __init__(self, robot: ForeignRobot) -> None:
        self._robot = robot
        self.topics: set[str] = set()
        self.events: list[str] = []

    def __call__(self) -> Reads:
        for topic, msg in self._robot.read(time.time()):
            self.topics.add(topic)
            if isinstance(msg, Event):
                self.events.append(msg.text)
        return self


@pytest.mark.parametrize("ros", [1, 2])
async def test_a_strange_robot_is_heard_driven_and_watched(ros: int) -> None:
    async with foreign(ros) as server, reached(server.port) as robot:
        assert robot.trouble == ""
        read = Reads(robot)
        await until(lambda: {"/odom", "/scan", "/battery_state", "/imu/data"} <= read().topics)
        assert "There is no map: driving by hand only." in read.events
        assert CAMERA not in read.topics
        robot.want(CAMERA, True)
        await until(lambda: CAMERA in read().topics)
        robot.drive(SPEED)
        await until(lambda: read() and server.robot.speed == pytest.approx(0.3))
        robot.stop()
        await until(lambda: server.robot.speed == 0.0)


@pytest.fixture
def careless(monkeypatch: pytest.MonkeyPatch) -> None:
    """Strange robots keep their last command for ever."""
    monkeypatch.setattr("tests.bridge.foreign_robot.WATCHDOG", 1e9)


@pytest.mark.usefixtures("careless")
async def test_a_robot_without_a_watchdog_rests_when_it_is_let_go() -> None:
    async with foreign() as server:
        async with reached(server.port) as robot:
            read = Reads(robot)
            robot.drive(SPEED)
            await until(lambda: read() and server.robot.speed == pytest.approx(0.3))
        await until(lambda: server.robot.speed == 0.0)


@pytest.mark.usefixtures("careless")
async def test_a_robot_that_went_on_alone_rests_first_of_all_when_it_is_reached_again() -> None:
    async with foreign() as server, wire(server.port) as cable, reached(cable.port) as robot:
        read = Reads(robot)
        robot.drive(SPEED)
        await until(lambda: read() and server.robot.speed == pytest.approx(0.3))
        cable.cut()
        await until(lambda: robot.trouble)
        robot.drive(SPEED)
        assert server.robot.speed == pytest.approx(0.3)
        await until(lambda: server.robot.speed == 0.0)
        await until(lambda: not robot.trouble)
        read()
        assert server.robot.speed == 0.0


def said_to(server: ForeignServer) -> list[tuple[str, str]]:
    """What the robot side has said over its present connection, of commands and of what it asks: operation and name."""
    names = {"publish": "topic", "advertise": "topic", "unadvertise": "topic", "call_service": "service"}
    ops = [op for peer in server.peers for op in peer.heard]
    return [(op["op"], op[names[op["op"]]]) for op in ops if op["op"] in names]


async def test_rest_is_said_before_anything_is_asked_when_a_robot_is_reached_again() -> None:
    async with foreign() as server, wire(server.port) as cable, reached(cable.port) as robot:
        cable.cut()
        await until(lambda: robot.trouble)
        await until(lambda: not robot.trouble)
        said = said_to(server)
        assert said.index(("publish", "/cmd_vel")) < said.index(("call_service", "/rosapi/topics"))


def drive_by(server: ForeignServer, name: str, kind: str) -> None:
    """Have the robot take its commands on `name` from now on."""
    del server.topics[server.command]
    server.command = name
    server.topic(name, kind)


async def test_one_that_is_driven_elsewhere_now_rests_by_the_old_topic_and_that_is_given_back() -> None:
    async with foreign() as server:
        drive_by(server, "/base/cmd_vel", "geometry_msgs/Twist")
        async with wire(server.port) as cable, reached(cable.port) as robot:
            cable.cut()
            await until(lambda: robot.trouble)
            drive_by(server, "/cmd_vel", "geometry_msgs/TwistStamped")
            await until(lambda: not robot.trouble)

            def told() -> list[tuple[str, str]]:
                said = said_to(server)
                asked = said.index(("call_service", "/rosapi/topics"))
                return [each for each in said[asked:] if each[1].endswith("cmd_vel")][:4]

            await until(lambda: len(told()) == 4)
            assert told() == [
                ("publish", "/base/cmd_vel"),
                ("unadvertise", "/base/cmd_vel"),
                ("advertise", "/cmd_vel"),
                ("publish", "/cmd_vel"),
            ]
            read = Reads(robot)
            robot.drive(SPEED)
            await until(lambda: read() and server.robot.speed == pytest.approx(0.3))


class Told:
    """What a link tells."""

    def __init__(self) -> None:
        self.reached = False

    def on_found(self, found: Found) -> None:
        self.reached = True

    def on_lost(self, sentence: str) -> None:
        self.reached = False

    def on_message(self, topic: str, msg: Msg) -> None:
        pass

    def on_held(self, sentence: str) -> None:
        pass


async def test_it_is_known_whether_the_last_command_left() -> None:
    async with foreign() as server, wire(server.port) as cable:
        told = Told()
        link = ForeignLink(f"ws://127.0.0.1:{cable.port}", told)
        try:
            await until(lambda: told.reached)
            link.drive(SPEED)
            await until(lambda: server.robot.speed > 0)
            assert not link.dropped
            cable.cut()
            await until(lambda: not told.reached)
            link.drive(Twist())
            await until(lambda: link.dropped)
        finally:
            with ThreadPoolExecutor(1) as aside:
                await asyncio.get_running_loop().run_in_executor(aside, link.close)


def test_an_address_that_can_never_work_is_said_at_once() -> None:
    with pytest.raises(BadAddress, match="must be like ws://"):
        ForeignRobot("robot:9090")


@asynccontextmanager
async def served(state: Path, robot: Robot, name: str = "") -> AsyncIterator[StationServer]:
    wall = time.time
    station = Station(robot, records_at(state), now=wall(), clock=wall, rng=random.Random(1), name=name)
    serves = StationServer(station, RobotClock(wall()), wall, Addresses("127.0.0.1", 0, 0))
    ready = asyncio.Event()
    running = asyncio.create_task(serves.run(lambda _: ready.set()))
    await ready.wait()
    try:
        yield serves
    finally:
        serves.end()
        await running


async def order(client: BridgeClient, service: str) -> str:
    answer = await client.call(service, CommandRequest(), CommandResponse)
    return answer.message


async def released(client: BridgeClient) -> str:
    """Hold Release; the answer at its end."""
    return await release_stop(partial(order, client), "STOP is released.".__eq__)


async def test_a_robot_side_drives_patrols_and_stops_through_another_and_rests_when_the_wire_is_cut(
    tmp_path: Path,
) -> None:
    far = FakeRobot()
    async with (
        served(tmp_path / "far", far, "Rex") as behind,
        wire(behind.server.port) as cable,
        reached(cable.port) as robot,
        served(tmp_path / "near", robot) as serves,
        connected(serves) as client,
    ):
        assert (robot.info.name, robot.info.max_speed) == ("Rex", 0.7)
        engine = serves.station.autonomy.engine
        serves.station.autonomy.place(ORIGIN)
        await until(lambda: not serves.station.fitness.unfit)

        client.publish("/cmd_vel", SPEED)
        await until(lambda: SPEED in far.commands)
        await until(lambda: far.at_rest)

        mission = Mission(waypoints=[Waypoint(0.8, 0.0), Waypoint(1.4, 0.0)], laps=1)
        await client.call("/mission/set", SetMissionRequest(mission=mission), CommandResponse)
        started = await client.call("/task/start", StartTaskRequest(), CommandResponse)
        assert started.message == "Patrol started: 2 points, loop."
        await until(lambda: far.pose[0] > 0.2)

        await order(client, "/stop")
        await until(lambda: far.at_rest)
        assert await released(client) == "STOP is released."
        # behind it is released a moment later
        await until(lambda: not behind.station.controls.stopped)
        await until(lambda: not (robot.trouble or serves.station.fitness.unfit))
        assert await order(client, "/task/resume") == "Resumed."
        await until(lambda: far.pose[0] > 0.5)

        cable.cut()
        await until(lambda: far.at_rest and engine.paused)
        await until(lambda: not robot.trouble)
        there, said = far.pose, len(far.commands)
        await until(lambda: None in far.commands[said:] or Twist() in far.commands[said:])
        assert (far.pose, engine.paused) == (there, True)
        # its laser is heard again a moment after the wire
        await until(lambda: not (robot.trouble or serves.station.fitness.unfit))
        assert await order(client, "/task/resume") == "Resumed."
        await until(lambda: not engine.active)
        assert engine.status.state == "SUCCEEDED"


async def test_a_robot_that_comes_later_is_taken(tmp_path: Path) -> None:
    far = FakeRobot()
    async with served(tmp_path / "far", far, "Rex") as behind:
        port = behind.server.port
    async with (
        reached(port) as robot,
        served(tmp_path / "near", robot) as serves,
        connected(serves) as client,
    ):
        assert "The robot cannot be reached" in robot.trouble
        await until(lambda: serves.station.events.since(0, ""))
        assert robot.trouble.split(":")[0] in serves.station.events.since(0, "")[-1].text
        answer = await client.call("/task/go_home", CommandRequest(), CommandResponse)
        assert not answer.success
        async with foreign(port=port) as server:
            await until(lambda: not robot.trouble)
            client.publish("/cmd_vel", SPEED)
            await until(lambda: server.robot.speed == pytest.approx(0.3))
