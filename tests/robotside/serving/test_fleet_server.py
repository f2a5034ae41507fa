"""Several robots in one robot side: one world, one clock, and everything else their own."""

from __future__ import annotations

import asyncio
import random
import socket
import time
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from pathlib import Path
from typing import TypeVar

import pytest

from bridge.client.client import BridgeClient
from bridge.core.errors import BridgeError
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    ControlStatus,
    PlaceArray,
    RobotInfo,
)
from bridge.msgs.sensor_msgs import Range, Temperature
from robotside.core.clock import RobotClock
from robotside.core.robot import Robot
from robotside.records.landmarks import take_over
from robotside.serving.fleet_server import FleetServer
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from sim.robot import make_several
from tests.fakes import FakeRobot
from tests.robotside.scene import records_at


class Side:
    """A robot side of several robots."""

    def __init__(self, robots: Sequence[Robot], state: Path, ports: Sequence[int] = ()) -> None:
        began = time.time() - time.monotonic()

        def wall() -> float:
            return began + time.monotonic()

        clock = RobotClock(wall())
        self.servings = []
        for number, robot in enumerate(robots):
            records = records_at(state / str(number))
            station = Station(robot, records, now=clock.now, clock=wall, rng=random.Random(number))
            take_over(robot, records, station.events.say)
            port = ports[number] if ports else 0
            self.servings.append(StationServer(station, clock, wall, Addresses("127.0.0.1", port, 0)))
        self.together = FleetServer(self.servings, clock, wall, wanted=lambda: self.wanted)
        self.wanted = True
        self.ready: list[StationServer] = []

    @asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        listens = asyncio.Event()

        def note(serving: StationServer) -> None:
            self.ready.append(serving)
            if len(self.ready) == len(self.servings):
                listens.set()

        running = asyncio.create_task(self.together.run(note))
        async with asyncio.timeout(60):
            await listens.wait()
            try:
                yield
            finally:
                self.together.end()
                await running


M = TypeVar("M", bound=Msg)


class Handheld:
    """A client of one of the robots."""

    def __init__(self, serving: StationServer) -> None:
        self.client = BridgeClient(serving.addresses.bridge)
        self._running = asyncio.create_task(self.client.run())

    async def next(self, topic: str, kind: type[M]) -> M:
        """The first message of `topic` from now on; what is latched comes at once."""
        told: asyncio.Future[M] = asyncio.get_running_loop().create_future()
        leave = self.client.subscribe(topic, kind, lambda msg, _: told.done() or told.set_result(msg))
        try:
            return await told
        finally:
            leave()

    async def close(self) -> None:
        await self.client.close()
        await self._running


@asynccontextmanager
async def handhelds(side: Side) -> AsyncIterator[list[Handheld]]:
    held = [Handheld(serving) for serving in side.servings]
    try:
        yield held
    finally:
        for each in held:
            await each.close()


async def test_each_robot_listens_for_itself_and_stop_holds_only_the_one_that_was_told(
    tmp_path: Path,
) -> None:
    robots = [FakeRobot(), FakeRobot()]
    side = Side(robots, tmp_path)
    async with side.running(), handhelds(side) as (one, other):
        assert len({serving.addresses.bridge for serving in side.ready}) == 2
        assert len({serving.addresses.http for serving in side.ready}) == 2
        await one.next("/robot/info", RobotInfo)
        await other.next("/robot/info", RobotInfo)
        assert (await one.client.call("/stop", CommandRequest(), CommandResponse)).success
        steered = asyncio.Event()
        side.servings[1].station.bus.subscribe(
            "/control/status",
            lambda _, msg: steered.set() if isinstance(msg, ControlStatus) and msg.driver else None,
        )
        assert other.client.publish("/cmd_vel", Twist.planar(0.3, 0.0))
        await steered.wait()
        stopped = [serving.station.controls.stopped for serving in side.servings]
    assert stopped == [True, False]
    assert [Twist.planar(0.3, 0.0) in robot.commands for robot in robots] == [False, True]
    assert all(robot.at_rest for robot in robots)


async def test_robots_of_one_world_are_told_one_time_and_each_by_its_own_topics(tmp_path: Path) -> None:
    robots = make_several(["scout", "scout"], "office", camera=False)
    side = Side(robots, tmp_path)
    try:
        async with side.running(), handhelds(side) as (one, other):
            infos = [await each.next("/robot/info", RobotInfo) for each in (one, other)]
            near = [await each.next("/odom", Odometry) for each in (one, other)]
            ring = await one.next("/sonar/4", Range)
            warm = await other.next("/temperature/left", Temperature)
            places = await one.next("/places", PlaceArray)
    finally:
        for robot in robots:
            robot.close()
    assert [info.name for info in infos] == ["Scout-1", "Scout-2"]
    assert abs(near[0].header.stamp.seconds - near[1].header.stamp.seconds) < 1.0
    assert ring.header.frame_id == "sonar_4"
    assert ring.max_range > 1.0
    assert 15.0 < warm.temperature < 40.0
    assert "reception" in {place.name for place in places.places}


async def test_a_port_that_is_taken_is_said_before_anybody_is_served(tmp_path: Path) -> None:
    robots = [FakeRobot(), FakeRobot()]
    with socket.create_server(("127.0.0.1", 0)) as other:
        taken = other.getsockname()[1]
        side = Side(robots, tmp_path, [0, taken])
        with pytest.raises(BridgeError, match=f"Port {taken} on 127.0.0.1 is taken"):
            await side.together.run(side.ready.append)
    assert side.ready == []
    freed = side.servings[0].addresses.port
    socket.create_server(("127.0.0.1", freed)).close()


async def test_all_of_them_end_when_they_are_no_longer_wanted(tmp_path: Path) -> None:
    robots = [FakeRobot(), FakeRobot()]
    side = Side(robots, tmp_path)
    side.wanted = False
    async with asyncio.timeout(60):
        await side.together.run(side.ready.append)
    assert len(side.ready) == 2
    assert all(robot.at_rest for robot in robots)


async def test_told_to_end_as_soon_as_it_listens_it_ends(tmp_path: Path) -> None:
    """A SIGTERM during a slow start: what announces the robots has not had its first turn by then."""
    side = Side([FakeRobot(), FakeRobot()], tmp_path)

    def ready(serving: StationServer) -> None:
        side.together.end()

    async with asyncio.timeout(60):
        await side.together.run(ready)


async def test_told_to_end_before_it_listens_it_ends(tmp_path: Path) -> None:
    robots = [FakeRobot(), FakeRobot()]
    side = Side(robots, tmp_path)
    side.together.end()
    async with asyncio.timeout(60):
        await side.together.run(side.ready.append)
    assert all(robot.at_rest for robot in robots)
