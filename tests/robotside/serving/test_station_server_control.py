"""Control over real sockets: STOP by HTTP, the way measured by the server, clocks that were never compared, a stalled line."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from websockets.asyncio.client import ClientConnection, connect

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse
from robotside.control.command_expiry import MAX_UNSTAMPED_AGE
from robotside.serving.station_server import StationServer
from tests.bridge.wires import wire
from tests.fakes import FakeRobot
from tests.releasing import release_stop
from tests.robotside.foreign.test_foreign_link import until
from tests.robotside.serving.test_station_server import connected, serving
from tests.robotside.visitor import visitor

SPEED = Twist.planar(0.3, 0.1)


async def publish(socket: ClientConnection, twist: Twist, stamp: float | None = None) -> None:
    """Say a drive command as a program that is not ours would."""
    msg = {"linear": {"x": twist.linear.x}, "angular": {"z": twist.angular.z}}
    when = {} if stamp is None else {"stamp": stamp}
    await socket.send(json.dumps({"op": "publish", "topic": "/cmd_vel", "msg": msg} | when))


def said(serves: StationServer) -> list[str]:
    return [event.text for event in serves.station.events.since(0, "")]


async def test_anybody_stops_the_robot_over_http(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with (
        serving(tmp_path, robot) as serves,
        connected(serves) as client,
        visitor(serves.addresses.http) as web,
    ):
        client.publish("/cmd_vel", SPEED)
        await until(lambda: SPEED in robot.commands)
        answer = await web.post("/stop?name=Fred%0A\u202e")
        assert (answer.status_code, answer.text) == (200, "Stopped.\n")
        assert robot.at_rest
        assert serves.station.controls.stopped_by == "Fred at 127.0.0.1 (not proven)"
        assert serves.station.controls.stopped_by_id == ""
        assert (await web.post("/stop")).status_code == 200
        asked = await web.get("/stop")
        assert (asked.status_code, asked.headers["allow"]) == (405, "POST")
        assert asked.text == "STOP is pressed by POST, from anywhere and by anyone.\n"
        await release_stop(
            lambda name: client.call(name, CommandRequest(), CommandResponse), lambda answer: answer.success
        )
        assert (await web.get("/stop")).status_code == 405
        assert not serves.station.controls.stopped


async def test_a_stop_over_http_that_may_not_have_reached_the_robot_says_so(tmp_path: Path) -> None:
    robot = FakeRobot()
    robot.silent = {"/odom"}
    async with serving(tmp_path, robot) as serves, visitor(serves.addresses.http) as web:
        robot.trouble = "The robot cannot be reached: nobody answers."
        answer = await web.post("/stop")
        assert (answer.status_code, answer.text) == (
            503,
            "STOP is pressed, but the robot cannot be reached: nobody answers.\n",
        )
        assert serves.station.controls.stopped


async def test_the_way_to_who_drives_is_measured_by_the_server(tmp_path: Path) -> None:
    async with serving(tmp_path, FakeRobot()) as serves, connected(serves):
        (session,) = serves.server.operators
        await until(lambda: not math.isnan(session.rtt))
        assert 0 <= session.rtt < 2
        assert session.answered >= session.opened
        await until(lambda: session.asked_time)


async def test_a_stamp_counts_only_from_who_has_asked_for_the_time(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with serving(tmp_path, robot) as serves, connect(serves.addresses.bridge) as socket:
        clock = serves.station.clock
        await publish(socket, SPEED, clock())
        await until(lambda: any("never compared with the robot's" in text for text in said(serves)))
        assert SPEED not in robot.commands
        await socket.send(json.dumps({"op": "call_service", "service": "/rosapi/get_time"}))
        await publish(socket, Twist(), clock())
        await publish(socket, SPEED, clock())
        await until(lambda: SPEED in robot.commands)


async def test_a_program_that_stamps_nothing_and_was_quiet_drives_at_its_first_word(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with serving(tmp_path, robot) as serves, connect(serves.addresses.bridge) as socket:
        (session,) = serves.server.operators
        opened = session.answered
        await until(
            lambda: session.answered > opened + MAX_UNSTAMPED_AGE
        )  # by pings alone: it has said nothing
        await publish(socket, SPEED)
        await until(lambda: SPEED in robot.commands)


@pytest.mark.parametrize("stamped", [True, False], ids=["stamped", "not stamped"])
async def test_nothing_that_waited_in_a_stalled_line_moves_the_robot(tmp_path: Path, stamped: bool) -> None:
    robot = FakeRobot()
    async with (
        serving(tmp_path, robot) as serves,
        wire(serves.server.port) as cable,
        connect(f"ws://127.0.0.1:{cable.port}") as socket,
    ):
        clock = serves.station.clock
        await socket.send(json.dumps({"op": "call_service", "service": "/rosapi/get_time"}))
        await publish(socket, SPEED, clock() if stamped else None)
        await until(lambda: SPEED in robot.commands)
        cable.freeze()
        await until(lambda: robot.at_rest)
        told = len(robot.commands)
        stale = Twist.planar(0.6, 0.0)
        for _ in range(10):
            await publish(socket, stale, clock() if stamped else None)
        given = clock()
        await until(lambda: clock() > given + MAX_UNSTAMPED_AGE)
        cable.thaw()
        dropped = serves.station.controls.dropped
        await until(lambda: serves.station.controls.dropped >= dropped + 10)
        assert stale not in robot.commands[told:]
