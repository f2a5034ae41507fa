"""Opening handshakes of WebSockets: tokens, pages of browsers, cameras, and who may nothing any more."""

from __future__ import annotations

import asyncio

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from bridge.server.reception.pages import PagePolicy
from bridge.server.server import BridgeServer
from robotside.trust.permissions import needed_role
from tests.bridge.peers import Peer, peer
from tests.bridge.wires import Record, door, server

ROLES = {"w.key": Role.WATCH, "d.key": Role.DRIVE, "n.key": Role.NONE}


class Gate:
    """Knows a few tokens; of all others a program of this machine may drive and nobody else anything."""

    def __init__(self) -> None:
        self.admitted: list[bool] = []

    def admit(self, address: str, *, trusted: bool) -> Identity:
        self.admitted.append(trusted)
        return Identity("", "", Role.DRIVE) if trusted else STRANGER

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        if token not in ROLES:
            raise Refused("This key is not known here.")
        return Identity(token[0], f"Person {token[0]}", ROLES[token], proven=True)

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


def bearer(token: str) -> dict[str, str]:
    return {"Authorization": f"Bearer {token}"}


async def refused(robot: BridgeServer, path: str = "", **options: object) -> tuple[int, str]:
    with pytest.raises(InvalidStatus) as caught:
        async with peer(robot, path, **options):
            pass
    return caught.value.response.status_code, caught.value.response.body.decode()


async def test_a_token_in_the_handshake_is_who_comes() -> None:
    async with server(gate=Gate()) as robot, peer(robot, additional_headers=bearer("w.key")) as watcher:
        await watcher.settled()
        (operator,) = robot.operators
        assert (operator.identity.id, operator.identity.proven, operator.way) == ("w", True, "rosbridge")
        assert not operator.secure


@pytest.mark.parametrize("path", ["", "/camera/front"])
async def test_a_wrong_token_is_refused_with_one_sentence_and_joins_nothing(path: str) -> None:
    gone = Record()
    async with server(gate=Gate(), on_gone=gone, cameras=["front"]) as robot:
        status, said = await refused(robot, path, additional_headers=bearer("x.key"))
        assert (status, said) == (401, "This key is not known here.\n")
        status, said = await refused(robot, path, additional_headers=[*bearer("w.key").items()] * 2)
        assert status == 401
        assert not robot._handshakes.joined
    assert gone == []


@pytest.mark.parametrize(
    "headers", [{"Host": "evil.example"}, {"Host": "evil.example:9090", "Origin": "http://evil.example:9090"}]
)
async def test_a_name_that_was_bound_to_this_machine_by_somebody_else_reaches_nothing(
    headers: dict[str, str],
) -> None:
    async with server(gate=Gate()) as robot:
        said = "".join(f"{name}: {value}\r\n" for name, value in headers.items())
        assert await _raw_status(robot, said) == 403


async def _raw_status(robot: BridgeServer, headers: str) -> int:
    reader, writer = await asyncio.open_connection("127.0.0.1", robot.port)
    writer.write(
        f"GET / HTTP/1.1\r\n{headers}Upgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
    )
    async with asyncio.timeout(5):
        line = await reader.readline()
    writer.close()
    return int(line.split()[1])


@pytest.mark.parametrize("origin", ["https://evil.example", "http://localhost:3000", "null"])
async def test_a_page_of_another_origin_is_refused_even_on_this_machine(origin: str) -> None:
    async with server(gate=Gate(), cameras=["front"]) as robot:
        for path in ("", "/camera/front"):
            status, said = await refused(robot, path, origin=origin)
            assert status == 403
            assert "log" in said


async def test_an_allowed_page_is_let_in_as_a_program_is_and_not_by_the_robots_cookie() -> None:
    gate = Gate()
    robot = BridgeServer(door({"gate": gate}))
    await robot.start(port=0, pages=PagePolicy(["http://localhost:3000"], web_port=lambda: 8080))
    try:
        async with peer(robot, origin="http://localhost:3000") as page:
            assert (await page.call("/rosapi/nodes"))["result"]
            await page.say(op="auth", token="w.key", id="a")
            told = await page.hear()
            assert (told["op"], told["level"], told["id"]) == ("status", "info", "a")
            await page.settled()
        async with peer(robot, origin="http://localhost:8080") as own:
            await own.settled()
        cookies = {"Cookie": "pilothouse_8080=w.key"}
        async with peer(robot, origin="http://localhost:8080", additional_headers=cookies) as person:
            await person.settled()
            assert {operator.identity.id for operator in robot.operators} >= {"w"}
        async with peer(robot, origin="http://localhost:3000", additional_headers=cookies) as page:
            await page.settled()
            assert [operator.identity.id for operator in robot.operators].count("w") == 0
    finally:
        await robot.close()
    assert gate.admitted == [True, True, True]


async def test_a_camera_is_shown_to_those_who_may_watch_it() -> None:
    gone = Record()
    async with server(gate=Gate(), cameras=["front"], on_gone=gone) as robot:
        status, said = await refused(robot, "/camera/front", additional_headers=bearer("n.key"))
        assert status == 401
        assert "front" in said
        async with peer(robot, "/camera/front", additional_headers=bearer("w.key")) as watcher:
            await (await watcher.ws.ping())
        await gone.reach(2)
    assert [operator.identity.id for operator in gone] == ["n", "w"]


async def test_who_may_nothing_any_more_is_cut_off() -> None:
    doors = door({"gate": Gate()})
    robot = BridgeServer(doors, cameras=["front"])
    await robot.start(port=0)
    try:
        headers = {"additional_headers": bearer("w.key")}
        async with peer(robot, **headers) as person, peer(robot, "/camera/front", **headers) as watcher:
            await person.settled()
            await (await watcher.ws.ping())
            doors.expel(["w"])
            for each in (person, watcher):
                with pytest.raises(ConnectionClosed):
                    await _hear(each)
    finally:
        await robot.close()


async def _hear(each: Peer) -> None:
    async with asyncio.timeout(5):
        await each.ws.recv()
