"""The door itself: operators, demand, direction, calls and their limits, without a station."""

from __future__ import annotations

import asyncio
import math
import subprocess
import sys
from collections.abc import Awaitable, Callable
from typing import Any

import pytest

from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Action, Service
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, RobotInfo
from bridge.msgs.std_msgs import String
from robotside.core.bus import Bus
from robotside.door.calls_in_progress import MAX_CALLS
from robotside.door.door import URGENT, Door

Heard = list[tuple[str, Msg]]


def service(name: str, call: Callable[..., Any]) -> Service:
    return Service(name, "pilothouse_msgs/Command", CommandRequest, CommandResponse, call)


async def never(*_: object) -> CommandResponse:
    await asyncio.Event().wait()
    return CommandResponse()


def answer(*_: object) -> CommandResponse:
    return CommandResponse(True, "Done.")


def broken(*_: object) -> CommandResponse:
    raise ZeroDivisionError


def test_every_operator_has_an_id_of_its_own_whatever_gateway_it_came_by() -> None:
    door = Door(now=lambda: 7.0)
    first, second = door.join("192.0.2.1:5000"), door.join("192.0.2.1:5000")
    assert first.id != second.id
    assert (first.address, first.opened, first.last_heard) == ("192.0.2.1:5000", 7.0, 7.0)
    assert math.isnan(first.rtt)


def test_only_who_joined_is_gone_and_once() -> None:
    gone: list[object] = []
    door = Door(on_gone=gone.append)
    operator = door.join("a")
    door.leave("a viewer")
    for _ in range(2):
        door.leave(operator)
    assert gone == [operator]


def test_a_topic_is_wanted_as_long_as_one_asker_wants_it() -> None:
    wanted: list[tuple[str, bool]] = []
    door = Door(on_demand=lambda *demand: wanted.append(demand))
    end = door.subscribe("rosbridge", "/scan", print)
    door.subscribe("a viewer", "/scan", print)
    door.subscribe("a recorder", "/scan", print, wanted=False)
    end()
    end()
    assert wanted == [("/scan", True)]
    door.leave("a viewer")
    assert wanted == [("/scan", True), ("/scan", False)]
    door.leave("a recorder")
    assert len(wanted) == 2


def test_messages_come_until_the_asker_leaves() -> None:
    bus, heard = Bus(), Heard()
    door = Door(bus=bus)
    door.subscribe("one", "/odom", lambda *all: heard.append(all))
    bus.publish("/odom", Odometry())
    door.leave("one")
    bus.publish("/odom", Odometry())
    assert heard == [("/odom", Odometry())]


def test_the_last_message_comes_first_where_the_topic_is_latched() -> None:
    bus, heard = Bus(), Heard()
    door = Door(bus=bus)
    bus.publish("/odom", Odometry())
    bus.publish("/robot/info", RobotInfo(name="Rex"))
    for topic in ("/odom", "/robot/info"):
        door.subscribe("one", topic, lambda *all: heard.append(all))
    assert heard == [("/robot/info", RobotInfo(name="Rex"))]


def test_there_is_nothing_to_hear_on_a_topic_that_is_not() -> None:
    with pytest.raises(Refused, match='This robot has no topic "/nothing"'):
        Door().subscribe("one", "/nothing", print)


def test_pictures_may_be_wanted_though_no_table_has_their_topic() -> None:
    wanted: list[tuple[str, bool]] = []
    door = Door(pictures=["/camera/mast/image/compressed"], on_demand=lambda *demand: wanted.append(demand))
    door.subscribe("one", "/camera/mast/image/compressed", print)
    assert wanted == [("/camera/mast/image/compressed", True)]


def test_what_an_operator_publishes_goes_to_the_robot_and_to_who_subscribed() -> None:
    taken: list[tuple[Any, ...]] = []
    heard = Heard()
    door = Door(on_message=lambda *all: taken.append(all))
    operator = door.join("a")
    door.subscribe("other", "/cmd_vel", lambda *all: heard.append(all))
    door.publish(operator, "/cmd_vel", Twist.planar(0.1, 0.0), 5.0)
    assert taken == [(operator, "/cmd_vel", Twist.planar(0.1, 0.0), 5.0)]
    assert heard == [("/cmd_vel", Twist.planar(0.1, 0.0))]


@pytest.mark.parametrize(
    ("topic", "sentence"),
    [
        ("/odom", 'This robot does not listen to "/odom", it speaks there.'),
        ("/nothing", 'This robot does not listen to "/nothing".'),
    ],
)
def test_the_robot_takes_only_what_is_for_it(topic: str, sentence: str) -> None:
    taken: list[object] = []
    door = Door(on_message=lambda *all: taken.append(all))
    with pytest.raises(Refused) as caught:
        door.publish(door.join("a"), topic, Odometry(), None)
    assert (str(caught.value), taken) == (sentence, [])


def test_a_robot_that_fails_at_a_message_fails_no_gateway(caplog: pytest.LogCaptureFixture) -> None:
    door = Door(on_message=broken)
    door.publish(door.join("192.0.2.1:5000"), "/cmd_vel", Twist(), None)
    assert "/cmd_vel from 192.0.2.1:5000 failed" in caplog.text


def test_a_service_answers_at_once_where_it_can() -> None:
    door = Door(services=[service("/task/pause", answer)])
    assert door.call(door.join("a"), "/task/pause", CommandRequest()) == CommandResponse(True, "Done.")


async def test_what_there_is_not_is_refused() -> None:
    door = Door()
    operator = door.join("a")
    with pytest.raises(Refused, match='This robot has no service "/dance"'):
        door.call(operator, "/dance", CommandRequest())
    with pytest.raises(Refused, match='This robot has no action "/dance"'):
        await door.run(operator, "/dance", CommandRequest(), print)


@pytest.mark.parametrize("late", [False, True])
async def test_a_fault_of_the_robot_is_a_sentence_and_stands_in_the_log(
    late: bool, caplog: pytest.LogCaptureFixture
) -> None:
    async def fail(*_: object) -> CommandResponse:
        return broken()

    door = Door(services=[service("/task/pause", fail if late else broken)])
    with pytest.raises(Refused, match="The robot failed at /task/pause; its log says why."):
        await awaited(door.call(door.join("192.0.2.1:5000"), "/task/pause", CommandRequest()))
    assert "/task/pause from 192.0.2.1:5000 failed" in caplog.text
    assert "ZeroDivisionError" in caplog.text


async def test_a_goal_that_fails_is_a_sentence_too() -> None:
    async def fail(*_: object) -> CommandResponse:
        return broken()

    tell = Action("/tell", "pilothouse_msgs/Tell", CommandRequest, CommandResponse, String, fail)
    door = Door(actions=[tell])
    with pytest.raises(Refused, match="The robot failed at /tell; its log says why."):
        await door.run(door.join("a"), "/tell", CommandRequest(), print)


async def awaited(answer: Msg | Awaitable[Msg]) -> Msg:
    return answer if isinstance(answer, Msg) else await answer


async def test_an_answer_that_takes_too_long_is_refused() -> None:
    door = Door(services=[service("/places/set", never)])
    operator = door.join("a")
    with pytest.raises(Refused, match="/places/set gave no answer within 0.01 s."):
        await awaited(door.call(operator, "/places/set", CommandRequest(), 0.01))


@pytest.mark.parametrize("timeout", [None, 0.0, -1.0, math.nan])
async def test_without_a_time_limit_it_is_waited_for(timeout: float | None) -> None:
    done = asyncio.Event()

    async def when_done(*_: object) -> CommandResponse:
        await done.wait()
        return answer()

    door = Door(services=[service("/places/set", when_done)])
    waiting = asyncio.ensure_future(
        awaited(door.call(door.join("a"), "/places/set", CommandRequest(), timeout))
    )
    await asyncio.sleep(0)
    done.set()
    assert await waiting == answer()


def test_stop_and_control_go_before_everything_else_and_nothing_beside_them() -> None:
    control = {f"/control/{what}" for what in ("acquire", "release", "request", "grant", "object")}
    assert {"/stop", "/stop/hold", "/stop/release"} | control == URGENT
    assert Door().is_urgent("/stop")
    assert not Door().is_urgent("/task/start")


async def test_an_operator_has_so_many_calls_in_progress_and_stop_is_always_taken() -> None:
    door = Door(services=[service("/slow", never), *(service(name, answer) for name in URGENT)])
    busy, other = door.join("busy"), door.join("other")
    waiting = [start(door, busy) for _ in range(MAX_CALLS)]
    await asyncio.sleep(0)
    with pytest.raises(Refused, match="256 calls of this client wait for their answer already."):
        door.call(busy, "/slow", CommandRequest())
    for name in URGENT:
        assert door.call(busy, name, CommandRequest()) == answer()
    waiting.append(start(door, other))
    waiting.pop(0).cancel()
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    waiting.append(start(door, busy))
    await ended(waiting)


async def ended(waiting: list[asyncio.Task[Msg]]) -> None:
    await asyncio.sleep(0)
    for task in waiting:
        task.cancel()
    await asyncio.gather(*waiting, return_exceptions=True)


def start(door: Door, operator: Any) -> asyncio.Task[Msg]:
    return asyncio.ensure_future(awaited(door.call(operator, "/slow", CommandRequest())))  # type: ignore[return-value]


async def test_calls_of_an_operator_that_is_gone_are_forgotten() -> None:
    door = Door(services=[service("/slow", never)])
    operator = door.join("a")
    waiting = [start(door, operator) for _ in range(MAX_CALLS)]
    door.leave(operator)
    waiting.append(start(door, operator))
    await ended(waiting)
    assert not door._calls._count


def test_the_door_of_a_station_knows_no_transport() -> None:
    script = "import sys, robotside.door.station_door; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    names = loaded.stdout.split()
    assert "robotside.door.door" in names
    transports = (
        "websockets",
        "starlette",
        "uvicorn",
        "bridge.server",
        "bridge.client",
        "robotside.gateways",
    )
    assert [name for name in names if name.startswith(transports)] == []


def failing(*_: object) -> None:
    raise OSError("the port is gone")


def test_a_driver_who_leaves_is_gone_even_where_the_robot_fails_to_end_its_topics() -> None:
    gone: list[object] = []
    wants: list[Callable[[], None]] = [lambda: None, failing]
    door = Door(on_gone=gone.append, on_demand=lambda *_: wants.pop(0)())
    operator = door.join("a")
    door.subscribe(operator, "/odom", lambda *_: None)
    with pytest.raises(OSError, match="the port is gone"):
        door.leave(operator)
    assert gone == [operator]


def test_a_gateway_that_fails_at_a_message_costs_the_robot_and_others_nothing(
    caplog: pytest.LogCaptureFixture,
) -> None:
    bus, heard = Bus(), Heard()
    door = Door(bus=bus)
    door.subscribe("one", "/odom", failing)
    door.subscribe("other", "/odom", lambda topic, msg: heard.append((topic, msg)))
    door.subscribe("one", "/cmd_vel", failing)
    for _ in range(3):
        bus.publish("/odom", Odometry())
    door.publish(door.join("a"), "/cmd_vel", Twist(), None)
    assert heard == [("/odom", Odometry())] * 3
    assert [record.message for record in caplog.records] == [
        "A gateway failed at a message on /odom",
        "A gateway failed at a message on /cmd_vel",
    ]


def test_a_topic_that_the_robot_fails_to_make_is_asked_for_again_and_comes_once() -> None:
    bus, heard = Bus(), Heard()
    wants: list[Callable[[], None]] = [failing, lambda: None]
    door = Door(bus=bus, on_demand=lambda *_: wants.pop(0)())
    with pytest.raises(OSError, match="the port is gone"):
        door.subscribe("one", "/odom", lambda topic, msg: heard.append((topic, msg)))
    door.subscribe("one", "/odom", lambda topic, msg: heard.append((topic, msg)))
    bus.publish("/odom", Odometry())
    assert (heard, wants) == ([("/odom", Odometry())], [])
