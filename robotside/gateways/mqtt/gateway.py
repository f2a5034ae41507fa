"""The MQTT gateway of one robot."""

from __future__ import annotations

import asyncio
import secrets
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import msgspec

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import Role
from robotside.core.notice import Notice
from robotside.gateways.adapter import Surroundings
from robotside.gateways.broker.command_desk import CALL, Command, CommandDesk
from robotside.gateways.broker.losses import Losses, say_open
from robotside.gateways.broker.namesakes import LOST, OFFLINE, ONLINE, Namesakes
from robotside.gateways.broker.topic_feed import Sent, TopicFeed
from robotside.gateways.gateway_url import OWN, GatewayUrl
from robotside.gateways.mqtt.broker_line import BrokerLine, Heard, Reply
from robotside.gateways.mqtt.guide import guide
from robotside.gateways.mqtt.own_broker import OwnBroker
from robotside.gateways.mqtt.topic_names import PROBE, Asked, TopicNames
from robotside.gateways.payloads.offered import offered
from robotside.gateways.plain.stamps import read_stamp
from robotside.gateways.plain.visitor import STOP, refusal
from robotside.gateways.plain.visitors import Visitors

__all__ = ["MAX_EXPIRY", "MqttGateway"]

WAY, _BROKER = "mqtt", "MQTT broker"
MAX_EXPIRY = 10.0
"""A call whose message is good for longer needs a stamp [s]."""
MAX_KEPT_STOPS = 64
"""STOPs that a broker keeps, and that are remembered to have been pressed."""
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
        self._feed = TopicFeed(robot.door, WAY, url, self._role)
        secure = url.scheme == "mqtts"
        self._visitors = Visitors(robot.door, WAY, url.address, url.keys, role=self._role, secure=secure)
        self._desk = CommandDesk(self._visitors, self._feed)
        self._losses = Losses(WAY, _BROKER, url.address, robot.say)
        boot, name = robot.door.health.boot, robot.door.info.name
        self._namesakes = Namesakes(WAY, _BROKER, boot, name, robot.say)
        self._tasks: set[asyncio.Task[None]] = set()
        self._is_ending = False
        self._kept_stops: OrderedDict[bytes, None] = (
            OrderedDict()
        )  # those that were pressed, as the broker keeps them
        self._told_of: set[str] = set()
        id = f"probe-{secrets.token_hex(6)}"
        self._commands = BrokerLine(
            url,
            self._names.commands,
            self._on_command,
            probe=self._names.probe(id),
            kept=self._names.state,
            will=(self._names.state, self._state(LOST)),
            on_up=self._begin,
            on_down=self._on_lost,
        )
        stop_probe = self._names.probe(id, stop=True)
        self._stop = BrokerLine(url, self._names.stop, self._on_stop, probe=stop_probe, drops_stale=False)

    async def start(self) -> None:
        """Begin to reach for the broker; whether it is there or not, the robot goes on."""
        if self._broker is not None:
            await self._broker.start()
        say_open(self._say, WAY, f"reaches the {_BROKER}", self._role)
        for work in (self._commands.run(), self._stop.run(), self._feed.run(self._send), self._check()):
            self._tasks.add(asyncio.create_task(work))

    async def stop(self) -> None:
        """Say goodbye to the broker and end everything; nothing is left running."""
        self._is_ending = True
        self._feed.end()
        self._visitors.leave_all()
        farewell = self._state(OFFLINE)
        try:
            await self._commands.publish(
                self._names.state, farewell, retain=True, qos=1, timeout=FAREWELL_TIMEOUT
            )
        finally:
            await cancel_all(self._tasks)
            await self._desk.close()
            self._tasks.clear()
            self._visitors.leave_all()
            if self._broker is not None:
                await self._broker.stop()

    def endpoints(self) -> Mapping[str, str]:
        """The broker's URL, with the topic that all of the robot's begin with."""
        return {WAY: f"{self._url.scheme}://{self._url.address}/{self._names.root}"}

    def guide(self) -> str:
        """How a client uses it now."""
        return guide(self._url, self._names, offered(self._door, self._url.keys), self._feed.audience())

    def _state(self, state: str) -> bytes:
        health = self._door.health
        return msgspec.json.encode({"state": state, "robot": health.robot, "boot": health.boot})

    async def _begin(self) -> None:
        """The broker is reached: say who is here, and publish."""
        await self._commands.publish(self._names.guide, self.guide().encode(), retain=True, qos=1)
        await self._commands.publish(self._names.birth, self._feed.birth(), retain=True, qos=1)
        await self._say_online()
        self._feed.begin()

    async def _say_online(self) -> None:
        if not self._is_ending:  # after a goodbye it would be here for ever
            await self._commands.publish(self._names.state, self._state(ONLINE), retain=True, qos=1)

    def _on_lost(self, reason: str) -> None:
        """The broker is gone, and with it everybody behind it."""
        self._feed.end()
        self._visitors.leave_all()
        self._losses.lost(reason)

    async def _send(self, sent: Sent) -> None:
        topic = self._names.topic(sent.name)
        await self._commands.publish(topic, sent.payload, retain=sent.latched, seq=str(sent.number))

    async def _check(self) -> None:
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            self._visitors.leave_silent()
            self._losses.check(self._commands, self._stop)
            self._check_hearing()
            if self._namesakes.update(asyncio.get_running_loop().time()):
                await self._say_online()

    def _check_hearing(self) -> None:
        """Say once of a line that its broker let it subscribe and passes nothing on, as an access list may have it."""
        for line, topic in ((self._commands, self._names.commands[0]), (self._stop, self._names.stop[0])):
            if line.is_deaf and topic not in self._told_of:
                self._told_of.add(topic)
                what = "STOP" if line is self._stop else "a command"
                said = (
                    f"The {_BROKER} passes on to the robot nothing of what it publishes itself, so perhaps no {what} either: "
                    f"let it read {topic} and write there in the access list."
                )
                self._say("control", Notice(Code.GATEWAY_REFUSED, said, gateway=WAY, topic=topic), "alarm")

    def _on_stop(self, heard: Heard) -> None:
        """STOP, on a line that nothing else can fill."""
        asked = self._names.read(heard.topic)
        if asked is not None:
            self._press_stop(self._command(self._stop, asked, heard), heard)

    def _press_stop(self, command: Command, heard: Heard) -> None:
        """Press STOP; one that a broker has kept from before, though it was asked not to pass such on, once only."""
        if heard.retained and heard.early:
            kept = b"\0".join((heard.topic.encode(), heard.payload, heard.correlation or b""))
            if kept in self._kept_stops:
                return
            self._kept_stops[kept] = None
            while len(self._kept_stops) > MAX_KEPT_STOPS:
                self._kept_stops.popitem(last=False)
            said = f"The {_BROKER} keeps a STOP of {command.client} from before, which is pressed once. Remove it there."
            notice = Notice(Code.GATEWAY_RETAINED, said, operation=STOP)
            self._say("control", notice, "warn")
        self._desk.press_stop(command)

    def _on_state(self, heard: Heard) -> None:
        """A robot of this name is at the broker, or gone from there: what it is told this one must not do."""
        now = asyncio.get_running_loop().time()
        if self._namesakes.hear(heard.payload, now, self._visitors.leave_all):
            self._desk.start(self._say_online())

    def _on_command(self, heard: Heard) -> None:
        if heard.topic == self._names.state:
            self._on_state(heard)
            return
        asked = self._names.read(heard.topic)
        if asked is None or asked.name == PROBE:  # of another robot of this name
            return
        command = self._command(self._commands, asked, heard)
        if asked.name == STOP and asked.verb == CALL:
            # by both lines, since nobody sees which of them is deaf; one that is retained was sent now too, but where a broker
            # passes on what it kept from before though that is not asked for
            self._press_stop(command, heard)
            return
        try:
            self._obey(command, heard)
        except BridgeError as error:
            command.answer(refusal(error))

    def _obey(self, command: Command, heard: Heard) -> None:
        """Carry out what was asked; raises BridgeError when it is not."""
        self._namesakes.check()
        if heard.retained:
            what = command.name or command.verb
            said = f"{what} is not done: a command must not be retained by the broker."
            raise Refused(Notice(Code.GATEWAY_RETAINED, said, operation=what))
        self._desk.obey(
            command._replace(stamp=read_stamp(heard.properties.get("stamp"), "user property stamp"))
        )

    def _command(self, line: BrokerLine, asked: Asked, heard: Heard) -> Command:
        """What was asked for by a line, by which it is answered; without a stamp."""

        def send(topic: str, payload: bytes) -> None:
            line.reply(Reply(topic, payload, heard.correlation))

        return Command(
            asked.client,
            asked.verb,
            asked.name,
            heard.payload,
            partial(send, self._names.answer(asked.client, asked.name, heard.wish)),
            partial(send, self._names.feedback(asked.client, asked.name)),
            heard.properties.get("token", ""),
            dated=heard.expiry <= MAX_EXPIRY,
            id=heard.correlation or b"",
        )
