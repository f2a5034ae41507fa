"""The robot side in front of another robot side of ours, which has a STOP, drivers and tasks of its own."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager
from pathlib import Path
from typing import NamedTuple

from bridge.client.client import BridgeClient
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    Mission,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from robotside.core.pose2 import ORIGIN
from robotside.foreign.foreign_robot import ForeignRobot
from robotside.serving.station_server import StationServer
from robotside.station.station import Station
from tests.bridge.wires import Wire, wire
from tests.fakes import FakeRobot
from tests.robotside.foreign.test_foreign_link import order, reached, released, served, until
from tests.robotside.serving.test_station_server import connected

SPEED = Twist.planar(0.3, 0.1)
STOPPED = "The robot's own STOP is pressed, by Fred: release it there."
DRIVEN = "The robot is driven by Fred: ask there, or wait until it is released."
BUSY = "The robot is on a task of its own: pause it there, or press STOP."


class Two(NamedTuple):
    """A robot, the robot side behind, the one in front of it, and a client of each."""

    robot: FakeRobot
    behind: StationServer
    port: ForeignRobot
    front: StationServer
    fred: BridgeClient
    anna: BridgeClient
    cable: Wire


@asynccontextmanager
async def two(state: Path) -> AsyncIterator[Two]:
    robot = FakeRobot()
    async with (
        served(state / "far", robot, "Rex") as behind,
        connected(behind) as fred,
        wire(behind.server.port) as cable,
        reached(cable.port) as port,
        served(state / "near", port) as front,
        connected(front) as anna,
    ):
        fred_is = CommandRequest(client_id="fred", client_name="Fred")
        # whoever is in front has control, so that only the names are told here
        await fred.call("/task/pause", fred_is, CommandResponse)
        yield Two(robot, behind, port, front, fred, anna, cable)


def said(by: StationServer) -> list[str]:
    return [event.text for event in by.station.events.since(0, "")]


async def test_the_one_in_front_drives_under_its_own_name_and_its_stop_brings_the_robot_to_rest(
    tmp_path: Path,
) -> None:
    async with two(tmp_path) as it:
        assert "the robot side on " in it.behind.station.controls.driver.name  # type: ignore[union-attr]
        it.anna.publish("/cmd_vel", SPEED)
        await until(lambda: SPEED in it.robot.commands)
        assert await order(it.anna, "/stop") == "Stopped."
        await until(lambda: it.robot.at_rest)


async def test_stop_in_front_presses_the_stop_behind_and_releasing_it_releases_that(tmp_path: Path) -> None:
    async with two(tmp_path) as it:
        far = it.behind.station.controls
        await order(it.anna, "/stop")
        await until(lambda: far.stopped)
        assert far.stopped_by.startswith("the robot side on ")
        await until(lambda: it.port.trouble == "")
        assert await released(it.anna) == "STOP is released."
        await until(lambda: not far.stopped)


async def test_stop_in_front_is_pressed_behind_as_soon_as_that_is_reached_again(tmp_path: Path) -> None:
    async with two(tmp_path) as it:
        it.cable.cut()
        await until(lambda: "cannot be reached" in it.port.trouble)
        await order(it.anna, "/stop")
        await until(lambda: it.behind.station.controls.stopped)


async def stop_work(port: ForeignRobot) -> None:
    """Until the one in front has done what it was told about STOP."""
    link = port._link

    async def done() -> None:
        if link._pressing is not None:
            await asyncio.wait([link._pressing])

    async with asyncio.timeout(60):
        await asyncio.wrap_future(link._network.start(done()))


async def test_what_somebody_else_pressed_behind_is_not_released_from_the_front(tmp_path: Path) -> None:
    async with two(tmp_path) as it:
        await order(it.fred, "/stop")
        await until(lambda: it.port.trouble == STOPPED)
        await order(it.anna, "/stop")
        await released(it.anna)
        await stop_work(it.port)
        assert it.behind.station.controls.stopped_by == "Fred"


async def test_a_stop_that_was_pressed_before_the_robot_was_reached_is_pressed_behind(tmp_path: Path) -> None:
    loop = asyncio.get_running_loop()
    async with served(tmp_path, FakeRobot(), "Rex") as behind:
        with ThreadPoolExecutor(1) as aside:
            port = ForeignRobot(f"ws://127.0.0.1:{behind.server.port}", patience=0.0)
            try:
                port.press_stop()
                await until(lambda: behind.station.controls.stopped)
            finally:
                await loop.run_in_executor(aside, port.close)


async def test_a_stop_pressed_behind_is_told_in_front_and_can_be_released_where_it_was_pressed(
    tmp_path: Path,
) -> None:
    async with two(tmp_path) as it:
        await order(it.fred, "/stop")
        await until(lambda: it.port.trouble == STOPPED)
        await until(lambda: STOPPED in said(it.front))
        it.anna.publish("/cmd_vel", SPEED)
        await until(lambda: it.behind.station.controls.driver is None)
        assert await released(it.fred) == "STOP is released."
        await until(lambda: it.port.trouble == DRIVEN)
        assert await order(it.fred, "/control/release") == "Control is free."
        await until(lambda: it.port.trouble == "")
        await until(lambda: "The robot can be driven again; it stands still." in said(it.front))
        assert SPEED not in it.robot.commands
        it.anna.publish("/cmd_vel", Twist())
        it.anna.publish("/cmd_vel", SPEED)
        await until(lambda: SPEED in it.robot.commands)


async def test_a_task_is_paused_while_somebody_else_has_the_robot(tmp_path: Path) -> None:
    async with two(tmp_path) as it:
        station = it.front.station
        station.autonomy.place(ORIGIN)
        await until(lambda: not station.fitness.unfit)
        station.missions.store(Mission(waypoints=[Waypoint(4.0, 0.0)]))
        await it.anna.call("/task/start", StartTaskRequest(), CommandResponse)
        await until(lambda: it.robot.pose[0] > 0.1)
        await order(it.fred, "/stop")
        await until(lambda: station.autonomy.engine.paused)
        assert station.autonomy.engine.status.reason == f"Paused: {STOPPED[0].lower()}{STOPPED[1:]}"
        assert await order(it.anna, "/task/resume") == STOPPED


def begin_by_itself(far: Station) -> None:
    """Have the robot behind begin a patrol for which nobody has control any more."""
    far.autonomy.place(ORIGIN)
    far.missions.store(Mission(waypoints=[Waypoint(4.0, 0.0)]))
    far.controls.release(far.controls.driver.client)  # type: ignore[union-attr]
    far.autonomy.engine.start(far.autonomy.task_factory.task(TaskOrder(task="patrol")), far.now)
    far.publish_control()


async def test_stop_in_front_ends_what_the_robot_behind_does_by_itself(tmp_path: Path) -> None:
    async with two(tmp_path) as it:
        begin_by_itself(it.behind.station)
        await until(lambda: it.port.trouble == BUSY)
        await order(it.anna, "/stop")
        await until(lambda: it.behind.station.autonomy.engine.paused and it.robot.at_rest)


async def test_what_the_robot_behind_does_by_itself_outlasts_a_cut_line(tmp_path: Path) -> None:
    async with two(tmp_path) as it:
        begin_by_itself(it.behind.station)
        await until(lambda: it.port.trouble == BUSY)
        it.cable.cut()
        await until(lambda: "cannot be reached" in it.port.trouble)
        await until(lambda: it.port.trouble == BUSY)
        assert it.behind.station.autonomy.engine.running
