"""The Kafka gateway of one robot."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial

import msgspec
from aiokafka import ConsumerRecord
from aiokafka.errors import KafkaError

from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from robotside.core.notice import Notice
from robotside.gateways.adapter import Surroundings
from robotside.gateways.broker.command_desk import CALL, Command, CommandDesk
from robotside.gateways.broker.losses import Losses, say_open
from robotside.gateways.broker.namesakes import OFFLINE, ONLINE, Namesakes
from robotside.gateways.broker.topic_feed import Sent, TopicFeed
from robotside.gateways.gateway_url import OWN, GatewayUrl
from robotside.gateways.kafka.guide import guide
from robotside.gateways.kafka.kafka_line import KafkaLine, Record
from robotside.gateways.kafka.own_cluster import OwnCluster
from robotside.gateways.kafka.topic_names import MAX_HEADER, Asked, TopicNames, client_of, read_headers
from robotside.gateways.payloads.offered import offered
from robotside.gateways.plain.stamps import read_stamp
from robotside.gateways.plain.visitor import STOP, refusal
from robotside.gateways.plain.visitors import Visitors

__all__ = ["KafkaGateway"]

WAY, _BROKER = "kafka", "Kafka broker"
FAREWELL_TIMEOUT = 1.0
"""For the broker to take the last state [s]."""
_CHECK_PERIOD = 1.0
"""Between two looks for clients that are silent [s]."""
_NOBODY = "somebody by Kafka"
"""Who presses STOP by a record without a key."""


class KafkaGateway:
    """An `AdapterGateway`: the robot's topics at a broker, and commands from there."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        """Who shows no token has the role of the `url`; without one it may watch, and at the robot's own cluster do
        what programs of this machine may. BridgeError when that cannot be, and for a prefix that Kafka cannot have.
        """
        self._cluster = OwnCluster(url.host, url.port) if url.scheme == OWN else None
        self._door, self._say, self._url = robot.door, robot.say, url
        self._names = TopicNames(url.path, robot.door.info.name)
        self._role = Role.WATCH if url.role is None and self._cluster is None else url.role
        self._feed = TopicFeed(robot.door, WAY, url, self._role)
        secure = url.scheme == "kafkas"
        self._visitors = Visitors(robot.door, WAY, url.address, url.keys, role=self._role, secure=secure)
        self._desk = CommandDesk(self._visitors, self._feed)
        boot, name = robot.door.health.boot, robot.door.info.name
        self._namesakes = Namesakes(WAY, _BROKER, boot, name, robot.say)
        self._is_ending = False
        self._told_of: frozenset[str] = frozenset()
        self._tasks: set[asyncio.Task[None]] = set()
        self._aim()

    def _aim(self) -> None:
        """Make what depends on where the broker is."""
        names = self._names
        self._losses = Losses(WAY, _BROKER, self._url.address, self._say)
        self._commands = KafkaLine(
            self._url,
            (names.commands, names.state),
            self._on_record,
            writes=(names.answers, names.guide, names.birth),
            on_up=self._begin,
            on_beat=self._beat,
            on_down=self._on_lost,
        )
        stop = (names.stop,)
        self._stop = KafkaLine(self._url, stop, self._on_stop, writes=(names.answers,), drops_stale=False)

    async def start(self) -> None:
        """Begin to reach for the broker; whether it is there or not, the robot goes on."""
        if self._cluster is not None:
            await self._cluster.start()
            self._url = replace(self._url, scheme="kafka", host=self._cluster.host, port=self._cluster.port)
            self._aim()
        say_open(self._say, WAY, f"reaches the {_BROKER}", self._role)
        for work in (self._commands.run(), self._stop.run(), self._feed.run(self._send), self._check()):
            self._tasks.add(asyncio.create_task(work))

    async def stop(self) -> None:
        """Say goodbye to the broker and end everything; nothing is left running."""
        self._is_ending = True
        self._feed.end()
        self._visitors.leave_all()
        try:
            with suppress(KafkaError, TimeoutError):
                await self._commands.deliver(self._state(OFFLINE), FAREWELL_TIMEOUT)
        finally:
            await cancel_all(self._tasks)
            await self._desk.close()
            self._tasks.clear()
            self._visitors.leave_all()
            if self._cluster is not None:
                await self._cluster.stop()

    def endpoints(self) -> Mapping[str, str]:
        """The broker's URL, with what all topics of the robot begin with."""
        return {WAY: f"{self._url.scheme}://{self._url.address}/{self._names.root}"}

    def guide(self) -> str:
        """How a client uses it now."""
        own = self._cluster is not None
        payloads = offered(self._door, self._url.keys)
        return guide(self._url, self._names, payloads, self._feed.audience(), own=own)

    def _state(self, state: str) -> Record:
        health = self._door.health
        said = {"state": state, "robot": health.robot, "boot": health.boot, "time": self._door.now()}
        return Record(self._names.state, msgspec.json.encode(said), key=health.robot.encode())

    async def _begin(self) -> None:
        """The broker is reached: say who is here, and publish."""
        absent = await self._commands.prepare(map(self._names.topic, self._feed.names()))
        await self._commands.deliver(Record(self._names.guide, self.guide().encode()))
        await self._commands.deliver(Record(self._names.birth, self._feed.birth()))
        await self._beat()
        self._say_absent(absent)  # the broker is there, and so has not all of them been lost with it
        self._feed.begin()

    async def _beat(self) -> None:
        """Say that the robot is here; a broker that does not take it is lost."""
        if not self._is_ending:  # after a goodbye it would be here for ever
            await self._commands.deliver(self._state(ONLINE))

    def _say_absent(self, topics: list[str]) -> None:
        """Say once which topics the broker does not have."""
        new = frozenset(topics) - self._told_of
        if new:
            self._told_of |= new
            said = (
                f"The {_BROKER} does not take {len(new)} of the robot's topics, as {min(new)}: "
                "make them, or let the broker make topics by itself."
            )
            notice = Notice(Code.GATEWAY_REFUSED, said, gateway=WAY, topic=min(new))
            self._say("control", notice, "warn")

    def _on_lost(self, reason: str) -> None:
        """The broker is gone, and with it everybody behind it."""
        self._feed.end()
        self._visitors.leave_all()
        self._losses.lost(reason)

    async def _send(self, sent: Sent) -> None:
        headers = (("seq", str(sent.number).encode()),)
        await self._commands.send(Record(self._names.topic(sent.name), sent.payload, headers=headers))

    async def _check(self) -> None:
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            self._visitors.leave_silent()
            self._losses.check(self._commands, self._stop)
            self._namesakes.update(asyncio.get_running_loop().time())

    def _on_stop(self, record: ConsumerRecord) -> None:
        """STOP, on a line that nothing else can fill; whatever the record says."""
        self._press_stop(self._stop, record)

    def _press_stop(self, line: KafkaLine, record: ConsumerRecord) -> None:
        said = {key: value or b"" for key, value in record.headers}
        token = said.get("token", b"").decode(errors="replace")
        asked = Asked(CALL, STOP, None, token, said.get("id", b"")[:MAX_HEADER])
        self._desk.press_stop(self._command(line, client_of(record.key), asked, record))

    def _on_record(self, record: ConsumerRecord) -> None:
        if record.topic == self._names.state:
            now = asyncio.get_running_loop().time()
            self._namesakes.hear(record.value or b"", now, self._visitors.leave_all)
        elif (CALL, STOP.encode()) in record.headers:  # before anything else is read, which may be wrong
            self._press_stop(self._commands, record)
        else:
            self._obey(record)

    def _obey(self, record: ConsumerRecord) -> None:
        client = client_of(record.key)
        if not client:
            return  # nobody can be answered
        answer: Callable[[bytes], None] = partial(self._answer, self._commands, client, ())
        try:
            asked = read_headers(record.headers)
            command = self._command(self._commands, client, asked, record)
            answer = command.answer
            self._namesakes.check()
            self._desk.obey(command._replace(stamp=read_stamp(asked.stamp, "header stamp")))
        except BridgeError as error:
            answer(refusal(error))

    def _command(self, line: KafkaLine, client: str, asked: Asked, record: ConsumerRecord) -> Command:
        """What was asked for by a line, by which it is answered; without a stamp."""
        id = (("id", asked.id),) if asked.id else ()
        name = asked.name.encode()
        return Command(
            client or _NOBODY,
            asked.verb,
            asked.name,
            record.value or b"",
            partial(self._answer, line, client, ((asked.verb, name), *id)),
            partial(self._answer, line, client, (("feedback", name), *id)),
            asked.token,
            id=asked.id,
        )

    def _answer(
        self, line: KafkaLine, client: str, headers: tuple[tuple[str, bytes], ...], payload: bytes
    ) -> None:
        if client:
            line.reply(Record(self._names.answers, payload, client.encode(), headers))
