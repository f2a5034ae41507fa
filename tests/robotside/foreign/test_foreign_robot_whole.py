"""`python -m robotside serve --robot ros:…` as a process, a robot on a server that is not ours, and a handheld."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from bridge.client.client import BridgeClient
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Twist,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    Event,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    TaskStatus,
    Waypoint,
)
from bridge.msgs.sensor_msgs import LaserScan
from tests.bridge.client.foreign_server import ForeignServer, foreign
from tests.bridge.foreign_robot import chart
from tests.bridge.wires import Wire, link, wire
from tests.robotside.foreign.test_foreign_link import until

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[3]
REST = (0.0, 0.0)
NOWHERE = "The robot's position is unknown; place the robot on the map."


class Handheld:
    """Somebody connected, and what he is told."""

    def __init__(self, client: BridgeClient) -> None:
        self._client = client
        self.said: list[str] = []
        self.last: dict[str, Any] = {}
        client.subscribe("/events", Event, lambda msg, _: self.said.append(msg.text))
        for topic, kind in (("/task/status", TaskStatus), ("/odom", Odometry), ("/scan", LaserScan)):
            client.subscribe(topic, kind, self._keep(topic))

    def _keep(self, topic: str) -> Callable[[Any, float], None]:
        return lambda msg, _: self.last.update({topic: msg})

    async def ask(self, service: str, request: Msg | None = None) -> str:
        answer = await self._client.call(service, request or CommandRequest(), CommandResponse)
        return answer.message

    def push(self, speed: float = 0.3) -> None:
        """Push the stick."""
        self._client.publish("/cmd_vel", Twist.planar(speed, 0.0))

    def place(self, x: float, y: float) -> None:
        """Say where the robot is, looking along x."""
        here = PoseWithCovariance(Pose(Point(x, y), Quaternion(w=1.0)))
        self._client.publish("/initialpose", PoseWithCovarianceStamped(pose=here))

    @property
    def task(self) -> TaskStatus:
        return self.last.get("/task/status", TaskStatus())  # type: ignore[no-any-return]


@asynccontextmanager
async def started(port: int, state: Path) -> AsyncIterator[tuple[str, asyncio.subprocess.Process]]:
    words = (
        f"-m robotside serve --robot ros:ws://127.0.0.1:{port} --port 0 --http-port 0 --with-parent --state"
    )
    process = await asyncio.create_subprocess_exec(
        sys.executable, *words.split(), str(state), cwd=ROOT, stdout=asyncio.subprocess.PIPE
    )
    assert process.stdout is not None
    try:
        ready = (await process.stdout.readline()).decode()
        yield ready.partition("bridge=")[2].split()[0], process
    finally:
        if process.returncode is None:
            process.terminate()
        await process.communicate()


@asynccontextmanager
async def handheld(address: str) -> AsyncIterator[Handheld]:
    async with link(address) as line:
        yield Handheld(await line.connected())


class Heard(list[tuple[float, float]]):
    """Every command that reached the robot, as forward speed and turn."""

    def __init__(self, server: ForeignServer) -> None:
        super().__init__()
        self._pass_on = server.robot.command
        server.robot.command = self.take  # type: ignore[method-assign]

    def take(self, twist: dict[str, Any]) -> None:
        self.append((twist["linear"]["x"], twist["angular"]["z"]))
        self._pass_on(twist)


@asynccontextmanager
async def everything(state: Path, ros: int) -> AsyncIterator[tuple[ForeignServer, Wire, Handheld, Handheld]]:
    async with foreign(ros) as server, wire(server.port) as cable:
        server.publish("/map", "nav_msgs/OccupancyGrid", chart(), True)
        async with (
            started(cable.port, state) as (address, _),
            handheld(address) as anna,
            handheld(address) as ben,
        ):
            await until(lambda: anna.last.keys() >= {"/odom", "/scan"})
            yield server, cable, anna, ben


async def test_it_is_driven_does_a_task_and_stops(tmp_path: Path) -> None:
    async with everything(tmp_path, 2) as (server, _, anna, ben):
        assert await anna.ask("/control/acquire", CommandRequest(client_name="Anna")) == "You have control."
        anna.push()
        await until(lambda: server.robot.speed == pytest.approx(0.3))
        ben.push(-0.3)
        await until(lambda: any("Anna has control; ask there" in said for said in ben.said))
        await until(lambda: server.robot.speed == 0.0)
        assert server.robot.x > 0.0

        mission = Mission(waypoints=[Waypoint(0.6, 0.0), Waypoint(0.6, 0.5)], home=[Waypoint(0, 0)], laps=1)
        assert await anna.ask("/mission/set", SetMissionRequest(mission=mission)) == "Stored 2 points."
        assert await anna.ask("/task/start", StartTaskRequest()) == NOWHERE
        anna.place(server.robot.x, server.robot.y)
        await until(lambda: any("placed the robot" in said for said in anna.said))
        assert await anna.ask("/task/start", StartTaskRequest()) == "Patrol started: 2 points, loop."
        await until(lambda: anna.task.state == "SUCCEEDED")
        assert (server.robot.x, server.robot.y) == pytest.approx((0.6, 0.5), abs=0.3)

        assert await anna.ask("/task/go_home") == "Going home."
        await until(lambda: server.robot.speed > 0.05)
        assert (await ben.ask("/stop")).startswith("Stopped.")
        await until(lambda: server.robot.speed == 0.0 and anna.task.state == "PAUSED")
        assert "STOP is pressed" in await anna.ask("/task/resume")


async def test_a_cut_line_pauses_the_task_and_rest_is_the_first_word_after_it(tmp_path: Path) -> None:
    async with everything(tmp_path, 1) as (server, cable, anna, _):
        anna.place(0.0, 0.0)
        await until(lambda: any("placed the robot" in said for said in anna.said))
        mission = Mission(waypoints=[Waypoint(3.0, 0.0)], laps=1)
        assert await anna.ask("/mission/set", SetMissionRequest(mission=mission)) == "Stored 1 point."
        assert await anna.ask("/task/start", StartTaskRequest()) == "Patrol started: 1 point, loop."
        await until(lambda: server.robot.speed > 0.05)
        heard = Heard(server)
        cable.cut()
        await until(lambda: anna.task.state == "PAUSED")
        assert "Paused: the robot cannot be reached: the connection to" in anna.task.reason
        del heard[:]
        anna.push()
        await until(lambda: "The robot can be driven again; it stands still." in anna.said)
        await until(lambda: len(heard) > 5)
        assert set(heard) == {REST}
        assert anna.task.state == "PAUSED"
        assert await anna.ask("/task/resume") == "Resumed."
        await until(lambda: server.robot.speed > 0.05)


async def test_a_process_that_is_told_to_end_leaves_the_robot_at_rest(tmp_path: Path) -> None:
    async with foreign() as server:
        async with started(server.port, tmp_path) as (address, process), handheld(address) as anna:
            anna.push()
            await until(lambda: server.robot.speed == pytest.approx(0.3))
            heard = Heard(server)
            process.terminate()
            assert await process.wait() == 0
        await until(lambda: server.robot.speed == 0.0)
        assert heard[-1] == REST
