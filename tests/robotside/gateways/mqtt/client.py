"""A gateway that a test serves a robot by, and other programs at the broker."""

from __future__ import annotations

import asyncio
import json
import re
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from typing import Any

import aiomqtt
from paho.mqtt.packettypes import PacketTypes
from paho.mqtt.properties import Properties

from bridge.msgs.pilothouse_msgs import Event
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.mqtt.gateway import MqttGateway
from tests.robotside.gateways.mqtt.broker import Broker
from tests.robotside.scene import Scene

__all__ = ["AHEAD", "FRESH", "ROOT", "Client", "client", "codes", "driving", "online", "serving", "until"]

ROOT = "pilothouse/Fake-1"
AHEAD = {"linear": {"x": 0.2}}
FRESH = 2
"""Expiry of a command [s]."""


@asynccontextmanager
async def serving(
    scene: Scene, url: str, options: str = "role=drive", door: StationDoor | None = None
) -> AsyncIterator[MqttGateway]:
    say = scene.station.events.say
    address = read_url(f"{url}?{options}", {"mqtt": 1883})
    gateway = MqttGateway(Surroundings(door or scene.door, say), address)
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

    def __init__(self, mqtt: aiomqtt.Client, name: str) -> None:
        self.mqtt, self.name = mqtt, name
        self.heard: dict[str, list[Any]] = {}
        """Messages by topic."""
        self.numbers: dict[str, list[int]] = {}
        """Their numbers."""
        self._listening = asyncio.create_task(self._listen())

    async def _listen(self) -> None:
        async for message in self.mqtt.messages:
            topic, text = str(message.topic), bytes(message.payload).decode(errors="replace")
            is_own = f"/clients/{self.name}/" in topic and not re.search("/(answer|feedback)", topic)
            kept = json.loads(text) if text.startswith("{") and not is_own else text
            self.heard.setdefault(topic, []).append(kept)
            said = dict(getattr(message.properties, "UserProperty", ()))
            if "seq" in said:
                self.numbers.setdefault(topic, []).append(int(said["seq"]))

    async def send(
        self,
        what: str,
        message: object = None,
        *,
        expiry: int | None = None,
        retain: bool = False,
        wish: str = "",
        qos: int = 1,
        **properties: str,
    ) -> None:
        said = Properties(PacketTypes.PUBLISH)
        if expiry is not None:
            said.MessageExpiryInterval = expiry
        if wish:
            said.ResponseTopic = wish
        if properties:
            said.UserProperty = list(properties.items())
        raw = message if isinstance(message, bytes) else json.dumps(message or {}).encode()
        topic = f"{ROOT}/clients/{self.name}/{what}"
        await self.mqtt.publish(topic, raw, qos=qos, retain=retain, properties=said)

    async def ask(self, what: str, message: object = None, **said: Any) -> dict[str, Any]:
        """The answer to a command."""
        topic = said.get("wish") or f"{ROOT}/clients/{self.name}/answer/{what.partition('/')[2]}"
        had = len(self.heard.get(topic, ()))
        await self.send(what, message, **said)
        await until(lambda: len(self.heard.get(topic, ())) > had)
        answer = self.heard[topic][-1]
        assert isinstance(answer, dict)
        return answer

    async def told(self, topic: str) -> Any:
        """The newest message on a topic of the robot."""
        await until(lambda: f"{ROOT}/{topic}" in self.heard)
        return self.heard[f"{ROOT}/{topic}"][-1]

    async def close(self) -> None:
        self._listening.cancel()
        await asyncio.gather(self._listening, return_exceptions=True)


@asynccontextmanager
async def client(broker: Broker, name: str = "me") -> AsyncIterator[Client]:
    async with aiomqtt.Client("127.0.0.1", broker.port, protocol=aiomqtt.ProtocolVersion.V5) as mqtt:
        made = Client(mqtt, name)
        await mqtt.subscribe(f"{ROOT}/#", qos=1)
        try:
            yield made
        finally:
            await made.close()


def codes(scene: Scene) -> list[str]:
    return [msg.code for _, msg in scene.said if isinstance(msg, Event)]


async def online(me: Client) -> None:
    await until(
        lambda: {"state": "online", "robot": "Fake-1", "boot": "b1"} in me.heard.get(f"{ROOT}/state", ())
    )


async def driving(scene: Scene, me: Client) -> None:
    """The client drives the robot."""
    await me.ask("call/rosapi/get_time")
    await me.send("publish/cmd_vel", AHEAD, stamp=str(scene.clock))
    await until(lambda: not scene.robot.at_rest)
