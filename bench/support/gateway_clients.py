"""Clients of every protocol of a robot, `python -m bench.support.gateway_clients ENDPOINTS`, told what to do by lines of JSON.

ENDPOINTS is JSON: the URL of each protocol, by its name. Each client calls one service and waits for its answer, which its
library gives; when it began is written down by the clock that all processes of a machine share.

    {"do": "call", "ways": ["mqtt", …], "count": 200, "period": 0.05, "service": "/task/pause"}  all at once
    {"do": "flood", "ways": […], "service": …}     as fast as each is answered
    {"do": "rest"}                   no flood any more
"""

from __future__ import annotations

import asyncio
import json
import os
import random
import sys
import time
from collections.abc import Awaitable, Callable
from contextlib import AsyncExitStack
from typing import Any

__all__ = ["WAYS"]

ANSWER_TIMEOUT = 5.0
"""An answer that has not come after this is an error [s]."""
STOP = "/stop"
ENVELOPE = "http://schemas.xmlsoap.org/soap/envelope/"
IN_FLIGHT = 4
"""Calls of one client under way at a time while it floods."""

NAME = f"bench-{os.getpid()}"
"""Of this process's clients at brokers: answers to those of another process are not for them."""

Call = Callable[[str], Awaitable[dict[str, Any]]]
"""Calls a service, and returns its answer."""


async def rosbridge(url: str, stack: AsyncExitStack) -> Call:
    """By the JSON of rosbridge."""
    from websockets.asyncio.client import connect

    ws = await stack.enter_async_context(connect(url, compression=None))
    waiting = await _answers(stack, ws, "id")

    async def call(service: str) -> dict[str, Any]:
        number = waiting.new()
        await ws.send(json.dumps({"op": "call_service", "id": number, "service": service, "args": {}}))
        return await waiting.answer(number)

    return call


async def websocket(url: str, stack: AsyncExitStack) -> Call:
    """By plain messages."""
    from websockets.asyncio.client import connect

    ws = await stack.enter_async_context(connect(url, compression=None))
    waiting = await _answers(stack, ws, "id")

    async def call(service: str) -> dict[str, Any]:
        number = waiting.new()
        await ws.send(json.dumps({"call": service, "id": number}))
        return await waiting.answer(number)

    return call


async def mqtt(url: str, stack: AsyncExitStack) -> Call:
    """By MQTT 5, with its response topics."""
    import socket
    from urllib.parse import urlsplit

    import aiomqtt
    from paho.mqtt.packettypes import PacketTypes
    from paho.mqtt.properties import Properties

    parts = urlsplit(url)
    root, me = parts.path.strip("/"), NAME
    client = await stack.enter_async_context(
        aiomqtt.Client(
            parts.hostname or "",
            parts.port or 1883,
            protocol=aiomqtt.ProtocolVersion.V5,
            socket_options=[(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)],
        )
    )
    await client.subscribe(f"{root}/clients/{me}/answer/#")
    waiting = Waiting()

    async def listen() -> None:
        async for message in client.messages:
            data = getattr(message.properties, "CorrelationData", b"")
            waiting.came(data.decode(), json.loads(bytes(message.payload)))  # type: ignore[arg-type]

    await _beside(stack, listen())

    async def call(service: str) -> dict[str, Any]:
        number = waiting.new()
        properties = Properties(PacketTypes.PUBLISH)
        properties.MessageExpiryInterval = 2
        properties.CorrelationData = number.encode()
        await client.publish(f"{root}/clients/{me}/call{service}", b"{}", qos=0, properties=properties)
        return await waiting.answer(number)

    return call


async def kafka(url: str, stack: AsyncExitStack) -> Call:
    """By records of the topic for commands, or for STOP."""
    from urllib.parse import urlsplit

    from aiokafka import AIOKafkaConsumer, AIOKafkaProducer

    parts = urlsplit(url)
    root, me = parts.path.strip("/"), NAME
    settings = {"bootstrap_servers": f"{parts.hostname}:{parts.port}"}
    consumer = AIOKafkaConsumer(
        f"{root}.answers", auto_offset_reset="latest", fetch_max_wait_ms=10, **settings
    )
    producer = AIOKafkaProducer(**settings)
    for each in (consumer, producer):
        await each.start()
        stack.push_async_callback(each.stop)
    await consumer.seek_to_end()
    waiting = Waiting()

    async def listen() -> None:
        async for record in consumer:
            number = dict(record.headers).get("id", b"")
            waiting.came(number.decode(), json.loads(record.value or b"{}"))

    await _beside(stack, listen())

    async def call(service: str) -> dict[str, Any]:
        number = waiting.new()
        headers = [("call", service.encode()), ("stamp", str(time.time()).encode()), ("id", number.encode())]
        topic = "stop" if service == STOP else "commands"
        await producer.send(f"{root}.{topic}", b"{}", key=me.encode(), headers=headers)
        return await waiting.answer(number)

    return call


async def coap(url: str, stack: AsyncExitStack) -> Call:
    """By confirmable messages."""
    import aiocoap

    context = await aiocoap.Context.create_client_context()
    stack.push_async_callback(context.shutdown)

    async def call(service: str) -> dict[str, Any]:
        uri = f"{url}{service}" if service == STOP else f"{url}{service}?stamp={time.time()}"
        said = aiocoap.Message(code=aiocoap.POST, uri=uri, payload=b"{}", content_format=50)
        async with asyncio.timeout(ANSWER_TIMEOUT):
            answer = await context.request(said).response
        return {"text": answer.payload.decode()}

    return call


async def rest(url: str, stack: AsyncExitStack) -> Call:
    """By POST, on one connection that is kept."""
    import httpx

    client = await stack.enter_async_context(httpx.AsyncClient(timeout=ANSWER_TIMEOUT))

    async def call(service: str) -> dict[str, Any]:
        path = service if service == STOP else f"/services{service}"
        return dict((await client.post(f"{url}{path}", json={})).json())

    return call


async def soap(url: str, stack: AsyncExitStack) -> Call:
    """By envelopes that are written beforehand, as no client of SOAP is asynchronous."""
    import httpx

    client = await stack.enter_async_context(httpx.AsyncClient(timeout=ANSWER_TIMEOUT))
    operations = {STOP: "Stop", "/task/pause": "Pause"}

    async def call(service: str) -> dict[str, Any]:
        name = operations[service]
        body = f'<{name} xmlns="urn:pilothouse:robot:1"/>'
        said = f'<s:Envelope xmlns:s="{ENVELOPE}"><s:Body>{body}</s:Body></s:Envelope>'
        headers = {
            "Content-Type": "text/xml; charset=utf-8",
            "SOAPAction": f'"urn:pilothouse:robot:1#{name}"',
        }
        answer = await client.post(url, content=said, headers=headers)
        return {"text": answer.text}

    return call


class Waiting:
    """Calls that wait for their answer."""

    def __init__(self) -> None:
        self._count = 0
        self._waiting: dict[str, asyncio.Future[dict[str, Any]]] = {}

    def new(self) -> str:
        """The number of a new call."""
        self._count += 1
        number = f"{NAME}-{self._count}"
        self._waiting[number] = asyncio.get_running_loop().create_future()
        return number

    def came(self, number: str, answer: dict[str, Any]) -> None:
        """An answer came; STOP may come twice."""
        future = self._waiting.get(number)
        if future is not None and not future.done():
            future.set_result(answer)

    async def answer(self, number: str) -> dict[str, Any]:
        """The answer of a call; TimeoutError when none comes."""
        try:
            async with asyncio.timeout(ANSWER_TIMEOUT):
                return await self._waiting[number]
        finally:
            del self._waiting[number]


async def _answers(stack: AsyncExitStack, ws: Any, key: str) -> Waiting:
    waiting = Waiting()

    async def listen() -> None:
        async for text in ws:
            if isinstance(text, str) and text.startswith("{"):
                answer = json.loads(text)
                waiting.came(str(answer.get(key, "")), answer)

    await _beside(stack, listen())
    return waiting


async def _beside(stack: AsyncExitStack, work: Any) -> None:
    task = asyncio.create_task(work)

    async def end() -> None:
        task.cancel()
        await asyncio.wait({task})

    stack.push_async_callback(end)


WAYS: dict[str, Callable[[str, AsyncExitStack], Awaitable[Call]]] = {
    "rosbridge": rosbridge,
    "websocket": websocket,
    "mqtt": mqtt,
    "kafka": kafka,
    "coap": coap,
    "rest": rest,
    "soap": soap,
}
"""How to connect by each protocol."""


class Clients:
    """One client of each protocol."""

    def __init__(self, calls: dict[str, Call]) -> None:
        self._calls = calls
        self._flooding: set[asyncio.Task[None]] = set()
        self._floods = False
        self.errors: list[str] = []

    async def do(self, asked: dict[str, Any]) -> dict[str, Any]:
        """Do one thing, and say what came of it."""
        what = asked["do"]
        if what == "call":
            began = await asyncio.gather(*(self._some(way, asked) for way in asked["ways"]))
            return {"began": dict(zip(asked["ways"], began, strict=True)), "errors": self.errors}
        if what == "flood":
            self._floods = True
            for way in asked["ways"]:
                for _ in range(IN_FLIGHT):
                    self._flooding.add(asyncio.create_task(self._flood(way, asked["service"])))
            return {}
        self._floods = False  # each ends with the answer that it waits for
        await asyncio.gather(*self._flooding)
        self._flooding.clear()
        return {"errors": self.errors}

    async def _some(self, way: str, asked: dict[str, Any]) -> list[float]:
        """When each call of one client began [s]."""
        dice, began = random.Random(way), []
        for _ in range(asked["count"]):
            await asyncio.sleep(asked["period"] * dice.uniform(0.5, 1.5))
            began.append(time.monotonic())
            await self._call(way, asked["service"])
        return began

    async def _flood(self, way: str, service: str) -> None:
        while self._floods:
            await self._call(way, service)

    async def _call(self, way: str, service: str) -> None:
        try:
            await self._calls[way](service)
        except Exception as error:  # noqa: BLE001 - the bench counts them
            self.errors.append(f"{way}: {type(error).__name__}: {error}"[:200])
            await asyncio.sleep(0.1)


async def main(endpoints: dict[str, str]) -> None:
    """Connect, and do what the lines ask."""
    loop = asyncio.get_running_loop()
    async with AsyncExitStack() as stack:
        clients = Clients({way: await WAYS[way](url, stack) for way, url in endpoints.items()})
        print(json.dumps({"connected": list(endpoints)}), flush=True)
        while line := await loop.run_in_executor(None, sys.stdin.readline):
            print(json.dumps(await clients.do(json.loads(line))), flush=True)


if __name__ == "__main__":
    asyncio.run(main(json.loads(sys.argv[1])))
