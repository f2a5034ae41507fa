"""Commands that take a while: once each, answered when done, and none left behind."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from functools import partial
from pathlib import Path

import pytest

from bridge.codec import to_json
from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import BringUpGatewayRequest, BringUpGatewayResponse, CommandResponse
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.services.lasting_commands import LastingCommands
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene


class Slow:
    """Something that is done when `go` is set."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.begun, self.ended = scene, 0, 0
        self.go = asyncio.Event()
        self.fault: Exception | None = None
        self.commands = LastingCommands(scene.station, scene.door.trail)
        self.service: Service = self.commands.service(
            "/slow", self.judge, "BringUpGateway", BringUpGatewayRequest, BringUpGatewayResponse
        )

    def judge(self, client: Operator, asked: BringUpGatewayRequest) -> Callable[[], Awaitable[str]]:
        if asked.name == "wrong":
            raise Refusal(Notice(Code.GATEWAY_UNKNOWN, "No such thing.", gateway="wrong"))
        return partial(self.work, asked.name)

    async def work(self, name: str) -> str:
        self.begun += 1
        try:
            await self.go.wait()
            if self.fault is not None:
                raise self.fault
        finally:
            self.ended += 1
        return f"{name} is done."

    def ask(self, name: str = "it", id: str = "") -> CommandResponse | Awaitable[CommandResponse]:
        request = BringUpGatewayRequest(command_id=id, name=name)
        return self.service.call(self.scene.anna, request)  # type: ignore[return-value]


@pytest.fixture
async def slow(tmp_path: Path) -> Slow:
    return Slow(Scene(FakeRobot(), tmp_path))


async def answer(given: CommandResponse | Awaitable[CommandResponse]) -> CommandResponse:
    return given if isinstance(given, CommandResponse) else await given


async def test_one_that_is_sent_again_meanwhile_and_afterwards_is_done_once(slow: Slow) -> None:
    first, again = slow.ask(id="1"), slow.ask(id="1")
    slow.go.set()
    told = [await answer(each) for each in (first, again)]
    told.append(await answer(slow.ask(id="1")))
    assert [(each.success, each.message) for each in told] == [(True, "it is done.")] * 3
    assert slow.begun == 1


async def test_two_without_an_id_are_two(slow: Slow) -> None:
    slow.go.set()
    for each in (slow.ask("a"), slow.ask("b")):
        assert (await answer(each)).success
    assert slow.begun == 2


async def test_what_is_refused_at_once_or_in_the_end_has_its_code_however_often_it_is_sent(
    slow: Slow,
) -> None:
    for _ in range(2):
        given = slow.ask("wrong", id="1")
        assert isinstance(given, CommandResponse)
        assert (given.success, given.message, given.code) == (False, "No such thing.", "gateway_unknown")
    assert slow.begun == 0
    slow.go.set()
    slow.fault = Refusal(Notice(Code.GATEWAY_PORT_TAKEN, "Port 1 is taken.", gateway="it"))
    for _ in range(2):
        told = await answer(slow.ask(id="2"))
        assert (told.success, told.message, told.code) == (False, "Port 1 is taken.", "gateway_port_taken")
        assert b'"Port 1 is taken."' in to_json(told), "it goes over the wire"
    assert slow.begun == 1


async def test_a_fault_is_answered_and_tells_nothing_of_the_program(slow: Slow) -> None:
    slow.go.set()
    slow.fault = RuntimeError("secret")
    told = await answer(slow.ask())
    assert (told.success, told.message) == (False, "The robot failed at /slow; its log says why.")


async def test_it_is_done_though_who_asked_is_gone(slow: Slow) -> None:
    waiting = asyncio.ensure_future(answer(slow.ask()))
    await asyncio.sleep(0)
    waiting.cancel()
    await asyncio.gather(waiting, return_exceptions=True)
    slow.go.set()
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    assert (slow.begun, slow.ended) == (1, 1)


async def test_the_end_of_the_robot_ends_what_is_under_way(slow: Slow) -> None:
    before = asyncio.all_tasks()
    waiting = asyncio.ensure_future(answer(slow.ask()))
    await asyncio.sleep(0)
    await asyncio.sleep(0)
    await slow.commands.close()
    assert (slow.begun, slow.ended) == (1, 1)
    with pytest.raises(Refused, match="about to end"):
        await waiting
    assert asyncio.all_tasks() == before


async def test_one_that_is_too_old_is_not_begun(slow: Slow) -> None:
    request = BringUpGatewayRequest(stamp=slow.scene.clock - 60.0, name="it")
    told = slow.service.call(slow.scene.anna, request)
    assert isinstance(told, CommandResponse)
    assert (told.success, told.code) == (False, "command_late")
    assert slow.begun == 0


async def test_what_came_of_it_is_in_the_audit_log(slow: Slow) -> None:
    slow.go.set()
    slow.ask("wrong")
    await answer(slow.ask())
    rows = [(row.operation, row.outcome) for row in slow.scene.station.records.audit.rows()]
    assert rows[-2:] == [("call /slow", "refused gateway_unknown"), ("call /slow", "done")]
