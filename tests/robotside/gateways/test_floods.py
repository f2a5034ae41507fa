"""Floods of connections that ask for nothing: an operator stays, comes back, and STOP is answered by every way in."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from pathlib import Path

import httpx
import msgspec
import pytest
from websockets.asyncio.client import ClientConnection, connect

from robotside.gateways.http import camera_streams
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.rosbridge.gateway import RosbridgeGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.bridge.wires import TIMEOUT
from tests.certificates import client_context, tls
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene
from tests.robotside.visitor import visitor

COUNT = 200
"""Connections of a flood: more than there are places on either socket."""
ONE, MANY = ["127.0.0.2"], [f"127.0.0.{number}" for number in range(2, 42)]
HOSTS = [pytest.param(ONE, id="one address"), pytest.param(MANY, id="many addresses", marks=pytest.mark.slow)]


class Served:
    """A robot with its two sockets."""

    def __init__(self, scene: Scene, bridge: RosbridgeGateway, web: HttpGateway) -> None:
        self.scene, self.bridge, self.web = scene, bridge, web

    @property
    def stopped(self) -> bool:
        return self.scene.station.controls.stopped


@pytest.fixture
async def served(tmp_path: Path) -> AsyncIterator[Served]:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"])
    scene, context, pictures = Scene(robot, tmp_path), tls(tmp_path), PictureScaler()
    bridge = RosbridgeGateway(scene.door, "127.0.0.1", 0, pictures, float, tls=context)
    web = HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: "", tls=context)
    await bridge.start()
    await web.start()
    yield Served(scene, bridge, web)
    await web.stop()
    await bridge.stop()
    await pictures.close()


Opened = list[asyncio.StreamWriter]


@asynccontextmanager
async def flood(port: int, said: bytes, hosts: list[str]) -> AsyncIterator[Opened]:
    """`COUNT` connections, in turn from each of `hosts`, that say so much and then nothing."""
    opened: Opened = []
    try:
        for number in range(COUNT):
            with contextlib.suppress(OSError):
                _, writer = await asyncio.open_connection(
                    "127.0.0.1", port, local_addr=(hosts[number % len(hosts)], 0)
                )
                writer.write(said)
                opened.append(writer)
        yield opened
    finally:
        for writer in opened:
            writer.transport.abort()
        await asyncio.sleep(0)


@asynccontextmanager
async def operator(served: Served, scheme: str = "ws") -> AsyncIterator[ClientConnection]:
    context = client_context() if scheme == "wss" else None
    url = f"{scheme}://127.0.0.1:{served.bridge.port}"
    async with connect(url, ssl=context, proxy=None, compression=None, close_timeout=0.1) as ws:
        yield ws


async def call(ws: ClientConnection, service: str) -> bool:
    async with asyncio.timeout(TIMEOUT):
        await ws.send(json.dumps({"op": "call_service", "service": service, "id": service}))
        while True:
            answer = json.loads(await ws.recv())
            if answer.get("id") == service:
                return bool(answer["result"])


async def press_by_http(served: Served, scheme: str = "http") -> int:
    """As curl does it: one connection, one request."""
    where = f"{scheme}://127.0.0.1:{served.web.port}"
    async with httpx.AsyncClient(base_url=where, verify=client_context(), timeout=TIMEOUT) as web:
        return (await web.post("/stop")).status_code


NOTHING = {
    "nothing": b"",
    "half a handshake": b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgr",
    "half a TLS handshake": b"\x16\x03\x01\x02\x00\x01",
    "slow headers": b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Slow: " + b"a" * 500,
    "a body that does not come": b"POST /stop HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 9\r\n",
    "WebSockets that say nothing": (
        b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    ),
    "pictures that nobody reads": b"GET /snapshot/front.jpg HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
    "streams that nobody reads": b"GET /stream/front.mjpeg HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
}


@pytest.mark.parametrize("hosts", HOSTS)
@pytest.mark.parametrize("said", NOTHING.values(), ids=NOTHING)
async def test_an_operator_stays_another_comes_and_both_stop_the_robot(
    served: Served, said: bytes, hosts: list[str]
) -> None:
    async with AsyncExitStack() as stack:
        first = await stack.enter_async_context(operator(served))
        assert await call(first, "/rosapi/get_time")
        for port in (served.bridge.port, served.web.port):
            await stack.enter_async_context(flood(port, said, hosts))
        assert await call(first, "/rosapi/nodes")
        async with operator(served, "wss") as late:
            assert await call(late, "/rosapi/get_time")
            assert await call(late, "/stop")
        assert served.stopped
        assert await press_by_http(served) == 200
        assert await press_by_http(served, "https") == 200


@pytest.mark.parametrize("hosts", HOSTS)
async def test_stop_is_answered_while_everybody_is_busy_for_good(served: Served, hosts: list[str]) -> None:
    """Programs that take all places and use them: a newcomer still stops the robot, and an operator comes back."""
    async with AsyncExitStack() as stack:
        busy = [await stack.enter_async_context(_busy(served, hosts[n % len(hosts)])) for n in range(COUNT)]
        assert len(busy) == COUNT
        async with operator(served) as late:
            assert await call(late, "/stop")
            assert await call(late, "/rosapi/get_time")
        assert served.stopped


@asynccontextmanager
async def _busy(served: Served, host: str) -> AsyncIterator[None]:
    url = f"ws://127.0.0.1:{served.bridge.port}"
    with contextlib.suppress(OSError):
        ws = await connect(url, proxy=None, compression=None, local_addr=(host, 0), close_timeout=0.1)
        with contextlib.suppress(Exception):
            await call(ws, "/rosapi/nodes")
        try:
            yield
        finally:
            ws.transport.abort()
        return
    yield


async def test_viewers_of_the_camera_are_few_and_never_all_who_are_let_in(served: Served) -> None:
    assert camera_streams.MAX_VIEWERS < 48
    async with flood(served.web.port, NOTHING["streams that nobody reads"], ONE):
        where = f"http://127.0.0.1:{served.web.port}"
        async with visitor(where, timeout=TIMEOUT) as web:
            assert (await web.get("/healthz")).json()["ok"]
