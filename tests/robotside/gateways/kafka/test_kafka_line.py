"""The line to a broker by itself: a broker that passes nothing on, more than can be heard, and what bounds the queue."""

from __future__ import annotations

import asyncio
import math
from collections.abc import AsyncIterator
from types import SimpleNamespace
from typing import Any

import pytest
from aiokafka import TopicPartition
from aiokafka.errors import (
    KafkaConnectionError,
    KafkaError,
    KafkaTimeoutError,
    TopicAuthorizationFailedError,
    UnknownTopicOrPartitionError,
)

from bridge.core.async_tasks import cancel_all
from robotside.gateways.gateway_url import read_url
from robotside.gateways.kafka import kafka_line
from robotside.gateways.kafka.adapter import ADAPTER
from robotside.gateways.kafka.kafka_line import (
    MAX_BEHIND,
    MAX_REPLIES,
    MAX_UNCONFIRMED,
    KafkaLine,
    NotHeard,
    Record,
    _settings,
)

URL = read_url("kafka://127.0.0.1", ADAPTER.schemes)
PARTITION = TopicPartition("t", 0)


class FakeConsumer:
    """Says where it is and where the end is; at each look both go on."""

    def __init__(self, heard: int, came: int) -> None:
        self._heard, self._came = heard, came
        self.at = self.end = 0
        self.skips = 0

    def assignment(self) -> set[TopicPartition]:
        return {PARTITION}

    async def position(self, _: TopicPartition) -> int:
        self.at += self._heard
        return self.at

    async def end_offsets(self, _: object) -> dict[TopicPartition, int]:
        self.end += self._came
        return {PARTITION: self.end}

    async def seek_to_end(self) -> None:
        self.skips += 1
        self.at = self.end


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kafka_line, "BEAT_PERIOD", 0.0)
    monkeypatch.setattr(kafka_line, "MAX_DEAF", 3)


def line(**said: Any) -> KafkaLine:
    return KafkaLine(URL, ("t",), lambda record: None, **said)


async def look(made: KafkaLine, consumer: FakeConsumer, times: int) -> None:
    looking = asyncio.create_task(made._look(consumer))  # type: ignore[arg-type]
    for _ in range(times * 10):
        await asyncio.sleep(0)
        if looking.done():
            break
    looking.cancel()
    try:
        await looking
    except asyncio.CancelledError:
        return


async def test_a_broker_that_passes_nothing_on_is_lost() -> None:
    with pytest.raises(NotHeard, match="does not pass on what is in t"):
        await look(line(), FakeConsumer(heard=0, came=1), 10)


async def test_one_that_passes_on_what_comes_is_not_lost_nor_is_one_where_nothing_comes() -> None:
    for came in (0, 5):
        consumer = FakeConsumer(heard=came, came=came)
        await look(line(), consumer, 20)
        assert not consumer.skips


async def test_what_is_old_is_left_out_when_more_comes_than_can_be_heard_but_no_stop() -> None:
    flooded = FakeConsumer(heard=1, came=MAX_BEHIND + 10)
    await look(line(), flooded, 5)
    assert flooded.skips
    stops = FakeConsumer(heard=1, came=MAX_BEHIND + 10)
    await look(line(drops_stale=False), stops, 5)
    assert not stops.skips


class FullProducer:
    """Takes records and confirms none."""

    def __init__(self) -> None:
        self.taken: list[asyncio.Future[None]] = []

    async def send(self, *_: object, **__: object) -> asyncio.Future[None]:
        self.taken.append(asyncio.get_running_loop().create_future())
        return self.taken[-1]


async def test_records_that_wait_for_the_broker_are_bounded() -> None:
    made, producer = line(), FullProducer()
    made._producer, made._ready = producer, {"t"}  # type: ignore[assignment]

    async def flood() -> None:
        while True:
            await made.send(Record("t", b"{}"))

    flooding = asyncio.create_task(flood())
    for _ in range(3 * MAX_UNCONFIRMED):
        await asyncio.sleep(0)
    assert len(producer.taken) == MAX_UNCONFIRMED
    producer.taken[0].set_exception(KafkaTimeoutError())
    for _ in range(10):
        await asyncio.sleep(0)
    assert len(producer.taken) == MAX_UNCONFIRMED + 1
    flooding.cancel()
    await asyncio.gather(flooding, return_exceptions=True)


class LateProducer(FullProducer):
    """Has a topic once somebody has made it."""

    def __init__(self) -> None:
        super().__init__()
        self.asked, self.has = 0, False

    async def partitions_for(self, _: str) -> set[int]:
        self.asked += 1
        if not self.has:
            raise UnknownTopicOrPartitionError
        return {0}


async def test_a_topic_that_is_made_later_is_asked_for_again_after_a_while_and_published_then(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made, producer = line(), LateProducer()
    made._producer = producer  # type: ignore[assignment]

    async def keep_sending() -> None:
        for _ in range(50):
            await made.send(Record("t", b"{}"))
            await asyncio.sleep(0)

    await keep_sending()
    assert producer.asked == 1, "not at each record"
    await cancel_all(tuple(made._preparing.values()))
    monkeypatch.setattr(kafka_line, "PREPARE_PERIOD", 0.0)
    await keep_sending()
    assert producer.asked > 3
    assert not producer.taken
    producer.has = True
    await keep_sending()
    assert producer.taken
    assert not made._preparing


async def test_what_is_sent_without_a_connection_is_dropped() -> None:
    made = line()
    await made.send(Record("t", b"{}"))
    await made.deliver(Record("t", b"{}"))
    made.reply(Record("t", b"{}"))
    assert not made._replies
    assert await made.prepare(["t"]) == ["t"]
    assert made._beat == math.inf


def test_a_reason_is_a_part_of_a_sentence() -> None:
    made = line()
    assert made._reason(KafkaConnectionError("Unable to bootstrap from []")) == "it does not answer"
    assert made._reason(TimeoutError()) == "it does not answer"
    assert "let the robot have t; allow" in made._reason(TopicAuthorizationFailedError("t"))
    assert made._reason(KafkaError("full.")) == "full"
    known = KafkaLine(read_url("kafka://a:b@h", ADAPTER.schemes), (), lambda record: None)
    assert made._reason(TimeoutError()) + "; check the user and password" in known._reason(TimeoutError())


def test_a_user_and_tls_are_what_the_url_says() -> None:
    assert _settings(URL)["security_protocol"] == "PLAINTEXT"
    secured = _settings(read_url("kafkas://a:b@h", ADAPTER.schemes))
    assert (secured["security_protocol"], secured["sasl_plain_password"]) == ("SASL_SSL", "b")
    assert secured["ssl_context"].check_hostname


async def test_of_a_flood_that_was_fetched_at_once_one_record_is_heard_in_each_step() -> None:
    """Whatever else there is to do, a STOP by another protocol above all, waits for one record and not for all of them."""
    heard: list[int] = []

    async def fetched() -> AsyncIterator[Any]:
        for number in range(100):
            yield SimpleNamespace(topic="t", partition=0, offset=number)

    made = KafkaLine(URL, ("t",), lambda record: heard.append(record.offset))
    listening = asyncio.create_task(made._listen(fetched()))  # type: ignore[arg-type]
    for step in range(100):
        await asyncio.sleep(0)
        assert len(heard) <= step + 1
    await listening
    assert heard == list(range(100))


async def test_answers_that_wait_to_be_sent_are_bounded_and_the_oldest_go() -> None:
    made = line()
    made._came_up()
    for number in range(MAX_REPLIES + 10):
        made.reply(Record("t", b"%d" % number))
    assert len(made._replies) == MAX_REPLIES
    assert made._replies[0].value == b"10"
