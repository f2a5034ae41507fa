"""One line to a Kafka broker that comes back by itself: a consumer and a producer of its own.

A consumer belongs to no group. It begins at the end of its topics, so that nothing from before is heard; the line of STOP goes on
where it was, so that a STOP that was pressed while the broker was gone holds.
"""

from __future__ import annotations

import asyncio
import logging
import re
import ssl
from collections import deque
from collections.abc import AsyncIterator, Awaitable, Callable, Iterable, Sequence
from contextlib import asynccontextmanager, suppress
from typing import Any, NamedTuple

from aiokafka import AIOKafkaConsumer, AIOKafkaProducer, ConsumerRecord, TopicPartition
from aiokafka.errors import (
    KafkaConnectionError,
    KafkaError,
    TopicAuthorizationFailedError,
    UnknownTopicOrPartitionError,
)

from bridge.core.async_tasks import cancel_all
from robotside.gateways.broker.line import Line
from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["KafkaLine", "Record", "close_ends"]

log = logging.getLogger(__name__)

ANSWER_TIMEOUT = 2.0
"""For one answer of the broker [s]; a broker that gives none is lost."""
BEAT_PERIOD = 1.0
"""Between two looks whether the broker is there [s]."""
FETCH_WAIT = 0.02
"""For so long a broker may wait for more before it gives an answer without any record [s]."""
PREPARE_PERIOD = 5.0
"""From the answer that there is no such topic to the next question for it [s]: somebody may make it later."""
MAX_FETCH = 262144
"""Bytes of one partition that are fetched at a time."""
MAX_BEHIND = 1024
"""Records that wait to be heard for a second; those of more are left out, but for STOP."""
MAX_DEAF = 3
"""Looks, one after another, at which nothing was heard of what is there; then the broker is lost."""
MAX_REPLIES = 256
"""Answers that wait to be sent; beyond them the oldest are dropped."""
MAX_UNCONFIRMED = 64
"""Records that the broker has not confirmed; beyond them the robot's topics wait, and the newest of each goes on then."""

logging.getLogger("aiokafka").setLevel(
    logging.CRITICAL
)  # what it says is normal for a broker that comes and goes


class Record(NamedTuple):
    """A record for a topic."""

    topic: str
    value: bytes
    key: bytes | None = None
    headers: Sequence[tuple[str, bytes]] = ()


class NotHeard(Exception):
    """The broker is there, but does not pass on what is in a topic."""


class NoTopic(Exception):
    """The broker has no such topic and makes none, or does not let the robot have it."""


class KafkaLine(Line):
    """Connects, listens from the end of its topics, and does it again whenever that ends; owns its tasks."""

    faults = (KafkaError, OSError, TimeoutError, NotHeard, NoTopic)

    def __init__(
        self,
        url: GatewayUrl,
        topics: Sequence[str],
        on_record: Callable[[ConsumerRecord], None],
        *,
        writes: Sequence[str] = (),
        on_up: Callable[[], Awaitable[None]] | None = None,
        on_beat: Callable[[], Awaitable[None]] | None = None,
        on_down: Callable[[str], None] | None = None,
        drops_stale: bool = True,
    ) -> None:
        """It reads `topics`, and cannot do without writing to `writes`.

        `on_up()` is awaited after each connection, `on_beat()` every `BEAT_PERIOD`: what it raises ends the connection.
        Without `drops_stale` it goes on after a loss where it was.
        """
        super().__init__(on_down=on_down, drops_stale=drops_stale)
        self._url, self._topics, self._on_record = url, tuple(topics), on_record
        self._writes, self._on_up, self._on_beat = tuple(writes), on_up, on_beat
        self._producer: AIOKafkaProducer | None = None
        self._ready: set[str] = set()
        self._preparing: dict[str, asyncio.Task[None]] = {}
        self._unconfirmed: set[asyncio.Future[Any]] = set()
        self._replies: deque[Record] = deque(maxlen=MAX_REPLIES)
        self._wake = asyncio.Event()
        self._positions: dict[TopicPartition, int] = {}

    def reply(self, record: Record) -> None:
        """Send an answer as soon as that can be; it is dropped when the line is lost before."""
        if self.is_up:
            self._replies.append(record)
            self._wake.set()

    async def prepare(self, topics: Iterable[str]) -> list[str]:
        """See to it that the broker has topics; those that it has not."""
        wanted = list(topics)
        producer = self._producer
        if producer is None:
            return wanted
        done = await asyncio.gather(
            *(producer.partitions_for(topic) for topic in wanted), return_exceptions=True
        )
        absent = [
            topic for topic, found in zip(wanted, done, strict=True) if isinstance(found, BaseException)
        ]
        self._ready |= set(wanted) - set(absent)
        return absent

    async def send(self, record: Record) -> None:
        """Publish a record, once the broker has its topic; waits while `MAX_UNCONFIRMED` wait. Dropped without a connection."""
        if record.topic not in self._ready:
            self._begin_to_prepare(record.topic)
            return
        while len(self._unconfirmed) >= MAX_UNCONFIRMED:
            await asyncio.wait(self._unconfirmed, return_when=asyncio.FIRST_COMPLETED)
        if self._producer is not None:
            with suppress(KafkaError):  # the line's own task learns of it too
                self._watch(await self._hand_over(self._producer, record))

    async def deliver(self, record: Record, timeout: float = ANSWER_TIMEOUT) -> None:
        """Publish a record and wait for the broker, `timeout` [s] at most. Raises KafkaError or TimeoutError when it does not take it."""
        if self._producer is not None:
            async with asyncio.timeout(timeout):
                await asyncio.shield(self._watch(await self._hand_over(self._producer, record)))

    @staticmethod
    async def _hand_over(producer: AIOKafkaProducer, record: Record) -> asyncio.Future[Any]:
        confirmed: asyncio.Future[Any] = await producer.send(
            record.topic, record.value, key=record.key, headers=list(record.headers)
        )
        return confirmed

    def _watch(self, confirmed: asyncio.Future[Any]) -> asyncio.Future[Any]:
        """Count a record until it is confirmed, and look at what became of it."""
        self._unconfirmed.add(confirmed)
        confirmed.add_done_callback(self._confirmed)
        return confirmed

    def _confirmed(self, future: asyncio.Future[Any]) -> None:
        self._unconfirmed.discard(future)
        if not future.cancelled() and future.exception() is not None:
            log.debug("A record was not taken: %s", future.exception())

    def _begin_to_prepare(self, topic: str) -> None:
        """Ask for a topic that the broker did not have so far; what is sent meanwhile is dropped."""
        if self._producer is None or topic in self._preparing:
            return

        async def prepare() -> None:
            if await self.prepare([topic]):
                await asyncio.sleep(PREPARE_PERIOD)

        task = self._preparing[topic] = asyncio.create_task(prepare())
        task.add_done_callback(lambda _: self._preparing.pop(topic, None))

    async def _connect(self) -> None:
        async with self._opened() as (producer, consumer):
            self._producer = producer
            self._came_up()
            if self._on_up is not None:
                await self._on_up()
            self._look_alive()
            await self._until_one_ends(
                self._listen(consumer),
                self._watch_loop(),
                self._send_replies(producer),
                self._look(consumer),
            )

    def _forget(self) -> None:
        self._producer = None
        self._ready.clear()
        self._replies.clear()

    def _reason(self, error: Exception) -> str:
        """Why there is no connection, as part of a sentence."""
        if isinstance(error, TopicAuthorizationFailedError):
            topic = str(error.args[0] if error.args else "its topics")
            return f"it does not let the robot have {topic}; allow that in its access list"
        text = re.sub(r"^(\w+: |\[Errno -?\d+\] )", "", str(error).strip().rstrip("."))[:200]
        if not text or isinstance(error, TimeoutError | KafkaConnectionError):
            text = "it does not answer"
        # a broker ends a connection whose user it does not know without a word
        return text + ("; check the user and password in the gateway's URL" if self._url.user else "")

    @asynccontextmanager
    async def _opened(self) -> AsyncIterator[tuple[AIOKafkaProducer, AIOKafkaConsumer]]:
        """Both ends, for as long as this is open. They are closed whole, also when this is cancelled meanwhile."""
        common = _settings(self._url)
        producer = AIOKafkaProducer(**common)
        consumer = AIOKafkaConsumer(
            *self._topics,
            **common,
            group_id=None,
            auto_offset_reset="latest",
            fetch_max_wait_ms=round(FETCH_WAIT * 1000),
            max_partition_fetch_bytes=MAX_FETCH,
        )
        try:
            # the library leaves a connection open whose start is cancelled; each step of it is bounded by its own settings
            await _uncut(asyncio.create_task(self._begin(producer, consumer)))
            async with asyncio.timeout(ANSWER_TIMEOUT):
                await self._seek(consumer)
            yield producer, consumer
        finally:
            await _uncut(asyncio.create_task(self._close(producer, consumer)))

    async def _begin(self, producer: AIOKafkaProducer, consumer: AIOKafkaConsumer) -> None:
        await producer.start()
        await self._require(producer)
        await consumer.start()

    async def _require(self, producer: AIOKafkaProducer) -> None:
        """Raises NoTopic when the broker does not have what this line cannot do without, and makes none."""
        wanted = [*self._topics, *self._writes]
        done = await asyncio.gather(*map(producer.partitions_for, wanted), return_exceptions=True)
        for topic, found in zip(wanted, done, strict=True):
            if isinstance(found, UnknownTopicOrPartitionError):
                said = f"it has no topic {topic}; make it, or let the broker make topics by itself"
                raise NoTopic(said) from found
            if isinstance(found, BaseException):
                raise found
        self._ready |= set(wanted)

    async def _seek(self, consumer: AIOKafkaConsumer) -> None:
        """Go on where this line was, or begin at the end, from this moment on."""
        await consumer.seek_to_end()
        for partition in consumer.assignment():
            end = await consumer.position(partition)
            known = self._positions[partition] = min(self._positions.get(partition, end), end)
            if not self._drops_stale and known < end:
                consumer.seek(partition, known)

    async def _close(self, producer: AIOKafkaProducer, consumer: AIOKafkaConsumer) -> None:
        self._producer = None  # so that nothing more is begun by it
        await cancel_all(tuple(self._preparing.values()))
        await close_ends(producer, consumer)

    async def _listen(self, consumer: AIOKafkaConsumer) -> None:
        """Hear records until they are too old."""
        async for record in consumer:
            if self._is_stale():
                return
            self._positions[TopicPartition(record.topic, record.partition)] = record.offset + 1
            try:
                self._on_record(record)
            except Exception:
                log.exception("A record of %s failed", record.topic)
            await asyncio.sleep(0)  # a flood is fetched many at a time

    async def _look(self, consumer: AIOKafkaConsumer) -> None:
        """See every second that the broker is there and passes on what is in the topics; raises when it does not."""
        ends: dict[TopicPartition, int] = {}
        heard: dict[TopicPartition, int] = {}
        deaf = 0
        while True:
            async with asyncio.timeout(ANSWER_TIMEOUT):
                now = {each: await consumer.position(each) for each in consumer.assignment()}
                behind = {each: ends[each] - at for each, at in now.items() if at < ends.get(each, 0)}
                stuck = [each.topic for each in behind if now[each] == heard.get(each)]
                deaf = deaf + 1 if stuck else 0
                if deaf == MAX_DEAF:
                    raise NotHeard(f"it does not pass on what is in {stuck[0]}")
                if sum(behind.values()) > MAX_BEHIND and self._drops_stale:
                    log.warning(
                        "More comes on %s than can be heard: what is old is left out", self._topics[0]
                    )
                    await consumer.seek_to_end()
                heard, ends = now, await consumer.end_offsets(list(consumer.assignment()))
            if self._on_beat is not None:
                await self._on_beat()
            await asyncio.sleep(BEAT_PERIOD)

    async def _send_replies(self, producer: AIOKafkaProducer) -> None:
        while True:
            await self._wake.wait()
            self._wake.clear()
            while self._replies:
                with suppress(KafkaError):  # the line's own task learns of it too
                    self._watch(await self._hand_over(producer, self._replies.popleft()))


async def close_ends(producer: AIOKafkaProducer, consumer: AIOKafkaConsumer) -> None:
    """Close both ends of a line, whole."""
    try:
        await consumer.stop()
    except asyncio.CancelledError:
        # the library passes on that it cancelled a fetch which had not begun, and leaves the rest as it is
        await cancel_all(consumer._fetcher._pending_tasks)  # noqa: SLF001
        await consumer._client.close()  # noqa: SLF001
    finally:
        await producer.stop()


async def _uncut(task: asyncio.Task[None]) -> None:
    """Wait for a task to its end, whoever cancels this meanwhile."""
    try:
        await asyncio.shield(task)
    except asyncio.CancelledError:
        await asyncio.wait([task])
        raise


def _settings(url: GatewayUrl) -> dict[str, Any]:
    """What both ends are told."""
    tls = url.scheme == "kafkas"
    said: dict[str, Any] = {
        "bootstrap_servers": url.address,
        "client_id": "pilothouse",
        "request_timeout_ms": round(ANSWER_TIMEOUT * 1000),
        "retry_backoff_ms": 100,
        "security_protocol": ("SASL_" if url.user else "") + ("SSL" if tls else "PLAINTEXT"),
    }
    if tls:
        said["ssl_context"] = ssl.create_default_context()
    if url.user:
        said |= {
            "sasl_mechanism": "PLAIN",
            "sasl_plain_username": url.user,
            "sasl_plain_password": url.password,
        }
    return said
