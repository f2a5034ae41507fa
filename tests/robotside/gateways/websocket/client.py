"""A robot behind the plain WebSocket, and a client of it by another library than the robot's own code."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

from websockets.asyncio.client import ClientConnection, connect

from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.websocket.gateway import WebSocketGateway
from tests.bridge.wires import TIMEOUT
from tests.robotside.scene import Scene

__all__ = ["Client", "client", "serving"]


@asynccontextmanager
async def serving(
    scene: Scene, options: str = "role=drive", door: StationDoor | None = None, **around: Any
) -> AsyncIterator[WebSocketGateway]:
    """The gateway, at a free port."""
    url = read_url(f"ws://127.0.0.1:0?{options}", {"ws": 0})
    gateway = WebSocketGateway(Surroundings(door or scene.door, scene.station.events.say, **around), url)
    async with asyncio.timeout(TIMEOUT):
        await gateway.start()
        try:
            yield gateway
        finally:
            await gateway.stop()


class Client:
    """One connection."""

    def __init__(self, ws: ClientConnection) -> None:
        self.ws = ws

    async def say(self, said: object) -> None:
        """Send an object, or a text or bytes as they are."""
        await self.ws.send(said if isinstance(said, str | bytes) else json.dumps(said))

    async def hear(self, *keys: str) -> Any:
        """The next message with one of these keys, or the next picture for none."""
        while True:
            heard = await self.ws.recv()
            if isinstance(heard, bytes):
                if not keys:
                    return heard
                continue
            said = json.loads(heard)
            if any(key in said for key in keys):
                return said

    async def ask(self, said: object) -> Any:
        """What is answered: the response, or why it is refused."""
        await self.say(said)
        heard = await self.hear("answer", "refused", "result")
        return heard.get("response", heard)


@asynccontextmanager
async def client(gateway: WebSocketGateway, **options: Any) -> AsyncIterator[Client]:
    """A client that has heard the guide."""
    url = gateway.endpoints()["websocket"]
    async with connect(url, proxy=None, close_timeout=0.1, **options) as ws:
        made = Client(ws)
        await made.hear("guide")
        yield made
