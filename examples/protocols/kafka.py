"""Kafka: a broker that the robot has come to, with the robot's topics as path, `kafka://HOST:9092/pilothouse.Patrol-1`."""

from __future__ import annotations

import json
import time
import uuid
from collections.abc import Iterator
from urllib.parse import urlsplit

from confluent_kafka import Consumer, KafkaException, Producer, TopicPartition

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS = (KafkaException,)
"""What its library raises, beside what all raise."""


class _Kafka:
    def __init__(self, url: str, client: str) -> None:
        place = urlsplit(url)
        self._root, self._name = place.path.strip("/"), f"program-{client[:12]}"
        settings = {"bootstrap.servers": place.netloc, "socket.timeout.ms": 10_000, "log_level": 2}
        self._producer = Producer({**settings, "linger.ms": 0})
        self._consumer = Consumer({**settings, "group.id": self._name, "enable.auto.commit": False})
        self._ahead = 0.0
        """The robot's clock before this one [s]."""
        try:
            self._consumer.assign(
                [end for topic in ("state", "answers") for end in self._ends(f"{self._root}.{topic}")]
            )
            self._ahead = next(
                told["time"] - time.time()
                for _, told in self._records("state", "No robot is there.")
                if told["state"] == "online"
            )
        except BaseException:
            self.close()
            raise

    def _ends(self, topic: str) -> Iterator[TopicPartition]:
        """Where each partition of `topic` ends now: what is older is not read."""
        patience = time.monotonic() + ANSWER_TIMEOUT
        while not (found := self._consumer.list_topics(topic, timeout=10).topics[topic].partitions):
            if time.monotonic() > patience:
                raise TimeoutError(f"The broker has no topic {topic}.")
            time.sleep(0.2)  # the robot makes it when it comes
        for number in found:
            _, end = self._consumer.get_watermark_offsets(TopicPartition(topic, number), timeout=10)
            yield TopicPartition(topic, number, end)

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`."""
        number = uuid.uuid4().hex
        self._send("call", service, request, number)
        answers = self._records("answers", f"{service} gave no answer within {ANSWER_TIMEOUT:g} s.")
        return next(answer for found, answer in answers if found == number)

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._send("publish", topic, message, uuid.uuid4().hex)

    def _send(self, what: str, name: str, message: Answer, number: str) -> None:
        headers = {what: name, "stamp": str(time.time() + self._ahead), "id": number}
        self._producer.produce(f"{self._root}.commands", json.dumps(message), self._name, headers=headers)
        self._producer.flush(ANSWER_TIMEOUT)

    def _records(self, topic: str, otherwise: str) -> Iterator[tuple[str, Answer]]:
        """The id and the content of each record; TimeoutError, as said, when none comes any more."""
        end = time.monotonic() + ANSWER_TIMEOUT
        while time.monotonic() < end:
            record = self._consumer.poll(0.1)
            if record is not None and record.error() is None and record.topic() == f"{self._root}.{topic}":
                headers = dict(record.headers() or ())
                yield headers.get("id", b"").decode(), json.loads(record.value())
        raise TimeoutError(otherwise)

    def close(self) -> None:
        """Say goodbye, so that a robot that was driven from here rests, and end the connections."""
        self._send("bye", "", {}, "")
        self._consumer.close()


def open_way(url: str, client: str) -> Way:
    """Connections to the broker."""
    return _Kafka(url, client)
