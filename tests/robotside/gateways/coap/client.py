"""A robot behind CoAP, and a client of it: aiocoap's own, by its own sockets."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any, NamedTuple

from aiocoap import Context, Message
from aiocoap.numbers.codes import Code

from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.coap.gateway import CoapGateway
from robotside.gateways.gateway_url import read_url
from tests.bridge.wires import TIMEOUT
from tests.robotside.scene import Scene

__all__ = ["Answer", "Client", "client", "serving"]


@asynccontextmanager
async def serving(
    scene: Scene, options: str = "role=drive", door: StationDoor | None = None, **around: Any
) -> AsyncIterator[CoapGateway]:
    """The gateway, at a free port."""
    url = read_url(f"coap://127.0.0.1:0?{options}", {"coap": 0})
    gateway = CoapGateway(Surroundings(door or scene.door, scene.station.events.say, **around), url)
    async with asyncio.timeout(TIMEOUT):
        await gateway.start()
        try:
            yield gateway
        finally:
            await gateway.stop()


class Answer(NamedTuple):
    """What came back."""

    code: str
    """As `2.05`."""
    text: str

    @property
    def json(self) -> Any:
        return json.loads(self.text)


class Client:
    """One program, with a socket of its own."""

    def __init__(self, context: Context, url: str) -> None:
        self.context, self.url = context, url

    def request(self, method: str, path: str, message: object = None, **options: Any) -> Any:
        """A request under way, as aiocoap has it."""
        raw = (
            message
            if isinstance(message, bytes)
            else b""
            if message is None
            else json.dumps(message).encode()
        )
        made = Message(code=getattr(Code, method), uri=f"{self.url}{path}", payload=raw, **options)
        return self.context.request(made)

    async def ask(self, method: str, path: str, message: object = None, **options: Any) -> Answer:
        response = await self.request(method, path, message, **options).response
        return Answer(response.code.dotted, response.payload.decode(errors="replace"))

    async def post(self, path: str, message: object = None, **options: Any) -> Answer:
        return await self.ask("POST", path, message, **options)

    async def get(self, path: str, **options: Any) -> Answer:
        return await self.ask("GET", path, **options)


@asynccontextmanager
async def client(gateway: CoapGateway) -> AsyncIterator[Client]:
    context = await Context.create_client_context()
    try:
        yield Client(context, gateway.endpoints()["coap"])
    finally:
        await context.shutdown()
