"""The MQTT gateway of one robot."""

from __future__ import annotations

import asyncio
import logging
import math
from collections.abc import Awaitable, Coroutine, Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import msgspec

from bridge.codec import to_json
from bridge.core.async_tasks import cancel_all, wait
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Role
from bridge.core.topics import Topic
from bridge.msgs import Msg
from robotside.core.notice import Notice
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import OWN, GatewayUrl
from robotside.gateways.mqtt.broker_line import BrokerLine, Heard, Reply
from robotside.gateways.mqtt.guide import guide
from robotside.gateways.mqtt.namesakes import LOST, OFFLINE, ONLINE, Namesakes
from robotside.gateways.mqtt.own_broker import OwnBroker
from robotside.gateways.mqtt.topic_names import BYE, CALL, PUBLISH, Asked, TopicNames
from robotside.gateways.payloads.offered import offered
from robotside.gateways.payloads.table import key_of
from robotside.gateways.plain.outbox import Outbox
from robotside.gateways.plain.visitor import STOP, Visitor, refusal
from robotside.gateways.plain.visitors import Visitors

__all__ = ["MAX_EXPIRY", "MqttGateway"]

log = logging.getLogger(__name__)

MAX_EXPIRY = 10.0
"""A call whose message is good for longer needs a stamp [s]."""
MAX_CALLS = 256
"""Calls by this gateway that may wait for their answer at a time; STOP always may."""
FAREWELL_TIMEOUT = 1.0
"""For the broker to take the last state [s]."""
_CHECK_PERIOD = 1.0
"""Between two looks for clients that are silent [s]."""


class MqttGateway:
    """An `AdapterGateway`: the robot's topics at a broker, and commands from there."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        """Who shows no token has the role of the `url`; without one it may watch, and at the robot's own broker do
        what programs of this machine may. BridgeError when that cannot listen there.
        """
        self._broker = OwnBroker(url.host, url.port) if url.scheme == OWN else None
        if self._broker is not None:
            url = replace(url, scheme="mqtt", port=self._broker.port)
        self._door, self._say, self._url = robot.door, robot.say, url
        self._names = TopicNames(url.path, robot.door.info.name)
        self._role = Role.WATCH if url.role is None and self._broker is None else url.role
        self._address = url.address
        self._visitors = Visitors(
            robot.door, "mqtt", self._address, url.keys, role=self._role, secure=url.scheme == "mqtts"
        )
        self._outbox = Outbox(1 / url.rate)
        self._wake = asyncio.Event()
        self._tasks: set[asyncio.Task[None]] = set()
        self._calls: set[asyncio.Task[None]] = set()
        self._lost: set[BrokerLine] = set()  # connections of whose loss was told
        boot, name = robot.door.health.boot, robot.door.info.name
        self._namesakes = Namesakes(boot, name, robot.say)
        self._is_ending = False
        self._commands = BrokerLine(
            url,
            self._names.commands,
            self._on_command,
            kept=self._names.state,
            will=(self._names.state, self._state(LOST)),
            on_up=self._begin,
            on_down=self._on_lost,
        )
        self._stop = BrokerLine(url, self._names.stop, self._on_stop, drops_stale=False)

    async def start(self) -> None:
        """Begin to reach for the broker; whether it is there or not, the robot goes on."""
        if self._broker is not None:
            await self._broker.start()
        if self._role is not None and self._role > Role.WATCH:
            role = self._role.word
            said = f"Everybody who reaches the MQTT broker may {role} without a key."
            self._say("control", Notice(Code.GATEWAY_OPEN, said, gateway="mqtt", role=role), "warn")
        for work in (self._commands.run(), self._stop.run(), self._send(), self._check()):
            self._tasks.add(asyncio.create_task(work))

    async def stop(self) -> None:
        """Say goodbye to the broker and end everything; nothing is left running."""
        self._is_ending = True
        self._end_topics()
        self._visitors.leave_all()
        farewell = self._state(OFFLINE)
        try:
            await self._commands.publish(
                self._names.state, farewell, retain=True, qos=1, timeout=FAREWELL_TIMEOUT
            )
        finally:
            await cancel_all(self._tasks | self._calls)
            self._tasks.clear()
            self._visitors.leave_all()
            if self._broker is not None:
                await self._broker.stop()

    def endpoints(self) -> Mapping[str, str]:
        """The broker's URL, with the topic that all of the robot's begin with."""
        return {"mqtt": f"{self._url.scheme}://{self._address}/{self._names.root}"}

    def guide(self) -> str:
        """How a client uses it now."""
        audience = self._door.join(self._address, way="mqtt", role=self._role)
        role = audience.role(self._door.now())
        self._door.leave(audience)
        return guide(self._url, self._names, offered(self._door, self._url.keys), role)

    def _state(self, state: str) -> bytes:
        health = self._door.health
        return msgspec.json.encode({"state": state, "robot": health.robot, "boot": health.boot})

    async def _begin(self) -> None:
        """The broker is reached: say who is here, and publish."""
        await self._commands.publish(self._names.guide, self.guide().encode(), retain=True, qos=1)
        await self._say_online()
        self._begin_topics()

    async def _say_online(self) -> None:
        await self._commands.publish(self._names.state, self._state(ONLINE), retain=True, qos=1)

    def _on_lost(self, reason: str) -> None:
        """The broker is gone, and with it everybody behind it."""
        self._end_topics()
        self._visitors.leave_all()
        if self._commands not in self._lost:
            self._say_lost(self._commands, f"The MQTT broker at {self._address} is not reached", reason)

    def _say_lost(self, line: BrokerLine, what: str, reason: str) -> None:
        self._lost.add(line)
        notice = Notice(
            Code.GATEWAY_LOST, f"{what}: {reason}. It is tried again.", gateway="mqtt", reason=reason
        )
        self._say("control", notice, "warn")

    def _begin_topics(self) -> None:
        audience = self._door.join(self._address, way="mqtt", role=self._role)
        try:
            for topic in self._door.topics.values():
                if topic.to == "robot" or topic.on_demand or key_of(topic.name) not in self._url.keys:
                    continue
                try:
                    self._door.check(audience, "subscribe", topic.name)
                except Refused:
                    continue
                self._door.subscribe(self, topic.name, partial(self._put, topic), wanted=False)
        finally:
            self._door.leave(audience)

    def _end_topics(self) -> None:
        self._door.leave(self)
        self._outbox.clear()

    def _put(self, topic: Topic, name: str, msg: Msg) -> None:
        self._outbox.put(topic, msg)
        self._wake.set()

    async def _send(self) -> None:
        """Publish what the robot says, as fast as the broker takes it."""
        clock = asyncio.get_running_loop().time
        while True:
            sent = self._outbox.take(clock())
            if sent is None:
                left = self._outbox.wait(clock())
                await wait(self._wake, None if math.isinf(left) else left)
                continue
            name, msg = sent
            payload, latched = _written(name, msg), self._door.topics[name].latched
            if payload:
                await self._commands.publish(self._names.topic(name), payload, retain=latched, qos=0)

    async def _check(self) -> None:
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            self._visitors.leave_silent()
            self._check_lines()
            if self._namesakes.update(asyncio.get_running_loop().time()):
                await self._say_online()

    def _check_lines(self) -> None:
        """Tell of STOP's connection when it alone is lost, and of the broker once it is there to stay."""
        if self._commands.is_up and self._stop.fault and not self._lost:
            what = f"STOP has no connection of its own to the MQTT broker at {self._address}"
            self._say_lost(self._stop, what, self._stop.fault)
        elif self._lost and self._commands.is_standing and self._stop.is_standing:
            self._lost.clear()
            said = "The MQTT broker is reached again."
            self._say("control", Notice(Code.GATEWAY_UP, said, gateway="mqtt"))

    def _on_stop(self, heard: Heard) -> None:
        """STOP, on a line that nothing else can fill."""
        asked = self._names.read(heard.topic)
        if asked is not None:
            self._press_stop(self._stop, asked, heard)

    def _on_state(self, heard: Heard) -> None:
        """A robot of this name is at the broker, or gone from there: what it is told this one must not do."""
        now = asyncio.get_running_loop().time()
        if self._namesakes.hear(heard.payload, now, self._visitors.leave_all) and not self._is_ending:
            self._run(self._say_online())

    def _on_command(self, heard: Heard) -> None:
        if heard.topic == self._names.state:
            self._on_state(heard)
            return
        asked = self._names.read(heard.topic)
        if asked is None:
            return
        if asked.name == STOP and asked.verb == CALL:
            # by both lines, since nobody sees which of them is deaf; one that is retained was sent now too: what a broker
            # kept from before is not asked for
            self._press_stop(self._commands, asked, heard)
            return
        try:
            self._obey(asked, heard)
        except BridgeError as error:
            self._answer(self._commands, asked, heard, refusal(error))

    def _obey(self, asked: Asked, heard: Heard) -> None:
        """Carry out what was asked; raises BridgeError when it is not."""
        self._namesakes.check()
        if heard.retained:
            said = f"{asked.name or asked.verb} is not done: a command must not be retained by the broker."
            raise Refused(Notice(Code.GATEWAY_RETAINED, said, operation=asked.name or asked.verb))
        token = heard.properties.get("token", "")
        if asked.verb == BYE:
            self._visitors.leave_name(asked.client, token)
            return
        visitor, stamp = self._visitors.visit(asked.client, token), _stamp(heard)
        dated = heard.expiry <= MAX_EXPIRY
        if asked.verb == PUBLISH:
            visitor.publish(asked.name, heard.payload, stamp, dated=dated)
            return
        if len(self._calls) >= MAX_CALLS:
            raise Refused(f"{MAX_CALLS} calls by this gateway wait for their answer already.")
        answer = visitor.call(asked.name, heard.payload, stamp, dated=dated)
        self._settle(self._commands, asked, heard, answer)

    def _press_stop(self, line: BrokerLine, asked: Asked, heard: Heard) -> None:
        """Press STOP for anyone: a wrong token, or too many clients, are no reason not to."""
        try:
            visitor = self._visitors.newcomer(asked.client, heard.properties.get("token", ""))
        except Refused:
            visitor = self._visitors.newcomer(asked.client)
        answer = visitor.call(STOP, heard.payload)
        self._settle(line, asked, heard, answer, visitor)

    def _settle(
        self,
        line: BrokerLine,
        asked: Asked,
        heard: Heard,
        answer: bytes | Awaitable[bytes],
        visitor: Visitor | None = None,
    ) -> None:
        """Send the answer, now or when it is there; then `visitor`, who came for this alone, is gone."""
        if not isinstance(answer, bytes):
            self._run(self._later(line, asked, heard, answer, visitor))
            return
        self._answer(line, asked, heard, answer)
        if visitor is not None:
            self._visitors.leave(visitor)

    async def _later(
        self, line: BrokerLine, asked: Asked, heard: Heard, answer: Awaitable[bytes], visitor: Visitor | None
    ) -> None:
        try:
            self._answer(line, asked, heard, await answer)
        finally:
            if visitor is not None:
                self._visitors.leave(visitor)

    def _answer(self, line: BrokerLine, asked: Asked, heard: Heard, payload: bytes) -> None:
        topic = self._names.answer(asked.client, asked.name, heard.wish)
        line.reply(Reply(topic, payload, heard.correlation))

    def _run(self, work: Coroutine[Any, Any, None]) -> None:
        task = asyncio.create_task(work)
        self._calls.add(task)
        task.add_done_callback(self._calls.discard)


def _written(name: str, msg: Msg) -> bytes:
    """The message as JSON; empty for one that cannot be written, which is logged and ends no other."""
    try:
        return to_json(msg)
    except Exception:
        log.exception("A message on %s cannot be written as JSON", name)
        return b""


def _stamp(heard: Heard) -> float:
    """When the sender meant it [s, operators' clock]; NaN when it did not say so. Raises Refused for what is no time."""
    text = heard.properties.get("stamp")
    if text is None:
        return math.nan
    try:
        stamp = float(text)
    except ValueError:
        stamp = math.nan
    if not math.isfinite(stamp):
        raise Refused(f"The user property stamp is a time in seconds, not {text[:60]!r}.")
    return stamp
