"""Every protocol that there is, by the services of a robot that is served: up at its usual URL, told of, and nothing left afterwards."""

from __future__ import annotations

import asyncio
import random
import socket
import time
from collections import Counter
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from bridge.client.client import BridgeClient
from bridge.msgs.pilothouse_msgs import (
    BringDownGatewayRequest,
    BringDownGatewayResponse,
    BringUpGatewayRequest,
    BringUpGatewayResponse,
    Gateway,
    GatewayArray,
)
from robotside.core.clock import RobotClock
from robotside.gateways.discovery import adapters
from robotside.serving.station_server import Addresses, StationServer
from robotside.station.station import Station
from tests.fakes import FakeRobot
from tests.robotside.scene import records_at

pytestmark = pytest.mark.slow

PATIENCE = 120.0
"""For all that one protocol does [s]."""
TURNS = 25
"""What has not changed for so many looks has settled."""


class Manager:
    """A program that manages the robot over rosbridge, and listens to how its protocols are."""

    def __init__(self, client: BridgeClient) -> None:
        self._client = client
        self._told = asyncio.Event()
        self._gateways: dict[str, Gateway] = {}
        client.subscribe("/gateways", GatewayArray, self._hear)

    def _hear(self, message: GatewayArray, _: float) -> None:
        self._gateways = {each.name: each for each in message.gateways}
        self._told.set()

    async def until(self, name: str, state: str) -> Gateway:
        """That protocol, once the robot says that it is so."""
        while name not in self._gateways or self._gateways[name].state != state:
            self._told.clear()
            await self._told.wait()
        return self._gateways[name]

    async def up(self, name: str, url: str) -> BringUpGatewayResponse:
        request = BringUpGatewayRequest(name=name, url=url)
        return await self._client.call(
            "/gateways/bring_up", request, BringUpGatewayResponse, timeout=PATIENCE
        )

    async def down(self, name: str) -> BringDownGatewayResponse:
        request = BringDownGatewayRequest(name=name)
        return await self._client.call(
            "/gateways/bring_down", request, BringDownGatewayResponse, timeout=PATIENCE
        )


@asynccontextmanager
async def managed(state: Path) -> AsyncIterator[tuple[Manager, StationServer]]:
    clock, began = RobotClock(time.time()), time.time() - time.monotonic()

    def wall() -> float:
        return began + time.monotonic()

    station = Station(FakeRobot(), records_at(state), now=clock.now, clock=wall, rng=random.Random(1))
    server, ready = StationServer(station, clock, wall, Addresses("127.0.0.1", 0, 0)), asyncio.Event()
    running = asyncio.create_task(server.run(lambda _: ready.set()))
    await ready.wait()
    client = BridgeClient(server.addresses.bridge)
    manager, connected = Manager(client), asyncio.create_task(client.run())
    try:
        await manager.until("http", "up")
        yield manager, server
    finally:
        await client.close()
        await connected
        server.end()
        await running
        await asyncio.get_running_loop().shutdown_default_executor()  # it looked names up


def tasks() -> Counter[str]:
    return Counter(task.get_coro().__qualname__ for task in asyncio.all_tasks())


async def settled() -> Counter[str]:
    """What runs once that stays as it is: what begins with a robot side has begun."""
    before, same = tasks(), 0
    while same < TURNS:
        await asyncio.sleep(0.01)
        now = tasks()
        before, same = now, same + 1 if now == before else 0
    return before


def free(url: str) -> str:
    """The URL with a port that is free; as it is where it names none."""
    parts = urlsplit(url)
    if parts.port is None:
        return url
    with socket.socket() as probe, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
        datagrams.bind(("127.0.0.1", port))
    return parts._replace(netloc=f"127.0.0.1:{port}").geturl()


def listens(url: str) -> bool:
    port = urlsplit(url).port
    with socket.socket() as probe:
        return port is not None and probe.connect_ex(("127.0.0.1", port)) == 0


@pytest.mark.parametrize("name", sorted(adapters()))
async def test_it_is_up_at_its_usual_url_and_leaves_nothing_when_it_is_down(
    name: str, tmp_path: Path
) -> None:
    async with asyncio.timeout(PATIENCE), managed(tmp_path) as (manager, server):
        adapter = adapters()[name]
        before, url = await settled(), free(adapter.default)
        for _ in range(2):
            answer = await manager.up(name, url)
            assert answer.success, answer.message
            gateway = await manager.until(name, "up")
            assert gateway.endpoint in answer.message
            assert gateway.guide
            assert gateway.qr_rows
            answer = await manager.up(name, url)
            assert (answer.success, answer.code) == (False, "gateway_runs")
            assert (await manager.down(name)).success
            gone = await manager.until(name, "down")
            assert (gone.endpoint, gone.guide, gone.fault) == ("", "", "")
            own = urlsplit(gateway.endpoint).port != urlsplit(server.addresses.http).port
            assert not (own and listens(gateway.endpoint))
            while tasks() != before:  # noqa: ASYNC110 - what still ends, ends
                await asyncio.sleep(0.01)
        assert server.gateways.running == ()
