"""A third gateway beside rosbridge and HTTP: nothing else knows of it, and all the rules hold."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable
from pathlib import Path

import pytest

from bridge.core.errors import Refused
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    Place,
    RunTaskFeedback,
    RunTaskGoal,
    SetPlaceRequest,
    TaskOrder,
)
from robotside.gateways.gateway import Gateway
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.gateways.memory import MemoryClient, MemoryGateway
from tests.robotside.scene import Scene

FULL = Twist.planar(0.7, 0.0)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(5.0)
    return made


@pytest.fixture
def gateway(scene: Scene) -> MemoryGateway:
    return MemoryGateway(scene.door, scene.door.now)


def ask(client: MemoryClient, service: str, **words: str) -> CommandResponse:
    answer = client.call(service, CommandRequest(**words))
    assert isinstance(answer, CommandResponse)
    return answer


async def test_it_is_a_gateway_like_the_others(gateway: MemoryGateway, scene: Scene) -> None:
    shaped: Gateway = gateway
    await shaped.start()
    client = gateway.connect("carl")
    ask(client, "/control/acquire", client_id="carl", client_name="Carl")
    assert scene.control.driver == "Carl"
    await shaped.stop()
    assert scene.control.driver == ""
    assert shaped.endpoints() == {"memory": "memory:"}


def test_who_drives_by_it_has_control_and_the_cap_of_a_link_that_is_not_measured(
    gateway: MemoryGateway, scene: Scene
) -> None:
    client = gateway.connect("carl")
    client.publish("/cmd_vel", FULL, scene.clock)
    assert scene.robot.twist == Twist.planar(0.35, 0.0)
    scene.drive(FULL)
    assert scene.robot.twist == Twist.planar(0.35, 0.0), "Carl has control"
    assert scene.control.speed_cap == 0.5
    client.leave()
    assert scene.robot.at_rest
    scene.drive(FULL)
    scene.run(2.0)
    scene.drive(Twist())
    scene.drive(FULL)
    assert scene.robot.twist == FULL


def test_its_drive_commands_expire(gateway: MemoryGateway, scene: Scene) -> None:
    client = gateway.connect("carl")
    client.publish("/cmd_vel", FULL, scene.clock - 1.0)
    assert scene.robot.at_rest
    client.publish("/cmd_vel", FULL, scene.clock)
    assert scene.robot.at_rest, "zero has to be heard first"
    client.publish("/cmd_vel", Twist(), scene.clock)
    scene.run(0.05)
    client.publish("/cmd_vel", FULL, scene.clock)
    assert not scene.robot.at_rest
    scene.run(0.3)
    assert scene.robot.at_rest


async def test_stop_by_one_gateway_holds_for_all(gateway: MemoryGateway, scene: Scene) -> None:
    client = gateway.connect("carl")
    scene.drive(FULL)
    answer = ask(client, "/stop", client_name="Carl")
    assert (answer.success, scene.robot.at_rest, scene.station.controls.stopped_by) == (True, True, "Carl")
    scene.drive(FULL)
    assert scene.robot.at_rest
    assert (await scene.door.stop(FakeClient())).success
    assert scene.station.controls.stopped_by == "Carl"


async def test_a_command_that_comes_by_two_ways_is_done_once(gateway: MemoryGateway, scene: Scene) -> None:
    order = SetPlaceRequest(command_id="c1", client_id="anna", place=Place(name="Office", x=1.0, y=1.0))
    scene.anna.address = "memory:anna's first"
    first = await settled(scene.door.call(scene.anna, "/places/set", order))
    again = await settled(gateway.connect("anna").call("/places/set", order))
    assert again == first
    assert [place.name for place in scene.station.records.places.all()] == ["Office"]


async def settled(answer: Msg | Awaitable[Msg]) -> Msg:
    return answer if isinstance(answer, Msg) else await answer


async def test_a_goal_runs_and_tells_how_far_it_is(gateway: MemoryGateway, scene: Scene) -> None:
    told: list[Msg] = []
    goal = RunTaskGoal(order=TaskOrder(task="hold", duration=2.0))
    running = asyncio.ensure_future(gateway.connect("carl").run("/task/run", goal, told.append))
    await asyncio.sleep(0)
    scene.run_task()
    assert (await running).message == "Held for 2 s."  # type: ignore[attr-defined]
    assert told
    assert all(isinstance(each, RunTaskFeedback) for each in told)


def test_it_subscribes_and_what_the_robot_says_comes(gateway: MemoryGateway, scene: Scene) -> None:
    client, heard = gateway.connect("carl"), list[Msg]()
    client.subscribe("/odom", lambda _, msg: heard.append(msg))
    assert scene.robot.wanted["/odom"]
    scene.run(0.5)
    assert len(heard) >= 9
    assert all(isinstance(msg, Odometry) for msg in heard)
    client.leave()
    assert not scene.robot.wanted["/odom"]


def test_what_the_robot_publishes_no_client_may(gateway: MemoryGateway) -> None:
    with pytest.raises(Refused, match='This robot does not listen to "/odom", it speaks there.'):
        gateway.connect("carl").publish("/odom", Odometry())
