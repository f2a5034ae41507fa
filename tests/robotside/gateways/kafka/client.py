"""A gateway that a test serves a robot by, and other programs at the broker."""

from __future__ import annotations

import asyncio
import itertools
import json
import math
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

from aiokafka import AIOKafkaConsumer, AIOKafkaProducer

from bridge.msgs.pilothouse_msgs import Event
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import GatewayUrl, read_url
from robotside.gateways.kafka.adapter import ADAPTER
from robotside.gateways.kafka.gateway import KafkaGateway
from robotside.gateways.kafka.kafka_line import KafkaLine, close_ends
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.scene import Scene

__all__ = ["AHEAD", "ROOT", "Client", "client", "codes", "driving", "hold_back", "online", "serving", "until"]

ROOT = "pilothouse.Fake-1"
AHEAD = {"linear": {"x": 0.2}}
READ = (
    "answers",
    "state",
    "birth",
    "guide",
    "topics.odom",
    "topics.control.status",
    "topics.sim.ground_truth",
)
_NOW = object()


@asynccontextmanager
async def serving(
    scene: Scene, cluster: Cluster, options: str = "role=drive", door: StationDoor | None = None
) -> AsyncIterator[KafkaGateway]:
    url = read_url(f"kafka://{cluster.address}?{options}", ADAPTER.schemes)
    gateway = KafkaGateway(Surroundings(door or scene.door, scene.station.events.say), url)
    async with asyncio.timeout(60):
        await gateway.start()
        try:
            yield gateway
        finally:
            await gateway.stop()


async def until(so: Callable[[], object]) -> None:
    """Wait until it is so; the test's own time-out ends what never is."""
    while not so():  # noqa: ASYNC110 - what is waited for is no event
        await asyncio.sleep(0.005)


class Client:
    """Another program at the broker."""

    def __init__(
        self, scene: Scene, producer: AIOKafkaProducer, consumer: AIOKafkaConsumer, name: str
    ) -> None:
        self._scene, self._producer, self._consumer, self.name = scene, producer, consumer, name
        self._ids = itertools.count(1)
        self.heard: dict[str, list[Any]] = {}
        """Messages by topic, without the root; answers are those to this client."""
        self.headers: dict[str, list[dict[str, bytes]]] = {}
        """Their headers."""
        self._listening = asyncio.create_task(self._listen())

    async def _listen(self) -> None:
        async for record in self._consumer:
            topic = record.topic.removeprefix(f"{ROOT}.")
            if topic == "answers" and record.key != self.name.encode():
                continue
            text = record.value.decode()
            self.heard.setdefault(topic, []).append(json.loads(text) if text.startswith("{") else text)
            self.headers.setdefault(topic, []).append(dict(record.headers))

    async def put(
        self, topic: str, raw: bytes, headers: list[tuple[str, bytes]] | None = None, key: bytes | None = None
    ) -> None:
        """A record as it stands."""
        key = self.name.encode() if key is None else key
        await self._producer.send_and_wait(f"{ROOT}.{topic}", raw, key=key, headers=headers or [])

    async def send(
        self, verb: str, name: str = "", message: object = None, *, stamp: object = _NOW, **said: str
    ) -> None:
        """A command, with the stamp of now unless another one, or None for none, is given."""
        if stamp is not None:
            said["stamp"] = str(self._scene.clock if stamp is _NOW else stamp)
        headers = [(verb, name.encode()), *((key, value.encode()) for key, value in said.items())]
        raw = message if isinstance(message, bytes) else json.dumps(message or {}).encode()
        await self.put("commands", raw, headers)

    async def ask(self, verb: str, name: str, message: object = None, **said: Any) -> dict[str, Any]:
        """The answer to a command."""
        id = str(next(self._ids))
        await self.send(verb, name, message, id=id, **said)
        return await self.answer(id)

    async def answer(self, id: str) -> dict[str, Any]:
        """The answer with an id."""

        def found() -> list[dict[str, Any]]:
            pairs = zip(self.heard.get("answers", ()), self.headers.get("answers", ()), strict=True)
            return [
                each
                for each, headers in pairs
                if headers.get("id") == id.encode() and "feedback" not in headers
            ]

        await until(found)
        return found()[0]

    async def press_stop(self, raw: bytes = b"{}", **said: str) -> dict[str, Any]:
        """The answer to a STOP on the topic of its own."""
        id = str(next(self._ids))
        headers = [(key, value.encode()) for key, value in {"id": id, **said}.items()]
        await self.put("stop", raw, headers)
        return await self.answer(id)

    async def told(self, topic: str) -> Any:
        """The newest message on a topic of the robot."""
        await until(lambda: topic in self.heard)
        return self.heard[topic][-1]

    async def close(self) -> None:
        self._listening.cancel()
        await asyncio.gather(self._listening, return_exceptions=True)


@asynccontextmanager
async def client(
    scene: Scene, cluster: Cluster | GatewayUrl, name: str = "me", *, without: str = ""
) -> AsyncIterator[Client]:
    """Another program, that reads all of the robot's topics `without` one of them."""
    settings: dict[str, Any] = {"bootstrap_servers": cluster.address, "retry_backoff_ms": 20}
    producer = AIOKafkaProducer(**settings)
    topics = [f"{ROOT}.{each}" for each in READ if each != without]
    consumer = AIOKafkaConsumer(*topics, **settings, fetch_max_wait_ms=20, auto_offset_reset="earliest")
    try:
        await producer.start()
        await consumer.start()
        made = Client(scene, producer, consumer, name)
        try:
            yield made
        finally:
            await made.close()
    finally:
        await close_ends(producer, consumer)


def codes(scene: Scene) -> list[str]:
    return [msg.code for _, msg in scene.said if isinstance(msg, Event)]


async def online(gateway: KafkaGateway) -> None:
    """Both lines listen."""
    await until(lambda: math.inf not in (gateway._commands._beat, gateway._stop._beat))


def hold_back(line: KafkaLine) -> asyncio.Event:
    """The line is not made again before the event is set."""
    connect, gate = line._connect, asyncio.Event()

    async def later() -> None:
        await gate.wait()
        await connect()

    line._connect = later  # type: ignore[method-assign]
    return gate


async def driving(scene: Scene, me: Client) -> None:
    """The client drives the robot."""
    await me.ask("call", "/rosapi/get_time")
    await me.send("publish", "/cmd_vel", AHEAD)
    await until(lambda: not scene.robot.at_rest)
