"""Commands of clients that gave up: neither REST nor SOAP carries them out, nor what waited while the robot stood still."""

from __future__ import annotations

import asyncio
import socket
import time
from collections.abc import AsyncIterator
from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.gateways.adapter import Surroundings
from robotside.gateways.discovery import read_wish
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.http.presence import GONE, READ, note_presence, presence_of
from robotside.gateways.plain import standstills
from robotside.gateways.plain.standstills import Standstills
from tests.fakes import FakeRobot
from tests.robotside.gateways.rest.served import Served, serving
from tests.robotside.gateways.soap.served import TYPE, body, message
from tests.robotside.scene import Scene

CONTROL = message(body("CallService", service="/control/acquire"), clientId="gone").encode()
STOP = message(body("Stop")).encode()


def asked(path: str, content: bytes = b"", kind: str = "application/json") -> bytes:
    """A request as it is on the wire."""
    head = f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nClient-Id: gone\r\nConnection: close\r\n"
    return f"{head}Content-Type: {kind}\r\nContent-Length: {len(content)}\r\n\r\n".encode() + content


COMMANDS = {"rest": asked("/api/control"), "soap": asked("/soap", CONTROL, TYPE)}
STOPS = {
    "site": asked("/stop"),
    "rest": asked("/api/stop"),
    "soap": asked("/soap", STOP, TYPE),
}


@pytest.fixture
async def served(tmp_path: Path) -> AsyncIterator[Served]:
    """A robot with both protocols on its site."""
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(1.0)
    async with serving(scene, "?role=drive") as made:
        adapter, url = read_wish("soap=?role=drive")
        soap = adapter.make(Surroundings(made.door, scene.station.events.say, site=made.http.mounts), url)
        await soap.start()
        yield made
        await soap.stop()


def send(http: HttpGateway, request: bytes) -> socket.socket:
    """Hand a request to the kernel; the loop has no time to take it meanwhile."""
    made = socket.create_connection(("127.0.0.1", http.port))
    made.sendall(request)
    return made


async def answer_on(client: socket.socket) -> bytes:
    client.setblocking(False)
    said = b""
    async with asyncio.timeout(60):
        while part := await asyncio.get_running_loop().sock_recv(client, 65536):
            said += part
    client.close()
    return said


async def settle(served: Served) -> None:
    """All that was sent before has been carried out."""
    async with served.client() as web:
        for _ in range(3):
            assert (await web.get("guide")).status_code == 200


def stand_still(monkeypatch: pytest.MonkeyPatch) -> None:
    """The loop does nothing for longer than is allowed."""
    monkeypatch.setattr(standstills, "STALL_PERIOD", 0.01)
    monkeypatch.setattr(standstills, "STALL_TIMEOUT", 0.05)
    time.sleep(0.1)


@pytest.mark.parametrize("way", COMMANDS)
async def test_a_command_takes_control_while_its_client_waits(served: Served, way: str) -> None:
    await settle(served)  # a machine under load may have stood still while the robot was made
    assert b" 200 OK" in await answer_on(send(served.http, COMMANDS[way]))
    assert served.scene.control.driver


@pytest.mark.parametrize("way", COMMANDS)
async def test_a_command_of_a_client_that_has_gone_is_not_carried_out(served: Served, way: str) -> None:
    send(served.http, COMMANDS[way]).close()
    await settle(served)
    assert not served.scene.control.driver


@pytest.mark.parametrize("gives_up", [True, False])
@pytest.mark.parametrize("way", COMMANDS)
async def test_a_command_that_waited_through_a_standstill_is_not_carried_out(
    served: Served, monkeypatch: pytest.MonkeyPatch, way: str, gives_up: bool
) -> None:
    client = send(served.http, COMMANDS[way])
    if gives_up:
        client.close()
    stand_still(monkeypatch)
    if not gives_up:
        said = await answer_on(client)
        assert b" 503 " in said
        assert b"gateway_stale" in said
        assert b"Retry-After" in said or b"retry-after" in said
    await settle(served)
    assert not served.scene.control.driver


@pytest.mark.parametrize("way", COMMANDS)
async def test_a_command_whose_body_ends_across_a_standstill_is_not_carried_out(
    served: Served, monkeypatch: pytest.MonkeyPatch, way: str
) -> None:
    command = COMMANDS[way] if way == "soap" else asked("/api/control", b"{}")
    client = send(served.http, command[:-2])
    await settle(served)
    client.sendall(command[-2:])
    stand_still(monkeypatch)
    assert b"gateway_stale" in await answer_on(client)
    assert not served.scene.control.driver


@pytest.mark.parametrize("gives_up", [True, False])
@pytest.mark.parametrize("stands", [True, False])
@pytest.mark.parametrize("way", STOPS)
async def test_stop_is_pressed_all_the_same(
    served: Served, monkeypatch: pytest.MonkeyPatch, way: str, stands: bool, gives_up: bool
) -> None:
    client = send(served.http, STOPS[way])
    if gives_up:
        client.close()
    if stands:
        stand_still(monkeypatch)
    if not gives_up:
        assert b" 200 OK" in await answer_on(client)
    await settle(served)
    assert served.scene.station.controls.stopped


async def test_a_form_of_the_site_that_waited_is_not_carried_out(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = send(served.http, asked("/logout"))
    stand_still(monkeypatch)
    assert b" 503 " in await answer_on(client)


async def test_what_changes_nothing_is_answered_after_a_standstill(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    client = send(served.http, asked("/api/robot").replace(b"POST", b"GET"))
    stand_still(monkeypatch)
    assert b" 200 OK" in await answer_on(client)


async def test_who_leaves_before_its_turn_is_not_served() -> None:
    gone = [False]
    scope = {"method": "PUT", "state": {READ: 0.0, GONE: lambda: gone[0]}}
    made = note_presence(scope, Standstills())
    assert presence_of(scope) is made
    await made.confirm()
    gone[0] = True
    with pytest.raises(Refused) as refused:
        await made.confirm()
    assert refused.value.args[0].code == Code.GATEWAY_STALE
