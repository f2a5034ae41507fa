"""A Kafka cluster that tests take down, bring up on the same port, and have refuse: the mock cluster of librdkafka.

The library that confluent-kafka brings is spoken to itself, since its Python part knows only how to start one.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from tests.lacking import lacking, package

__all__ = ["STORAGE", "UNAUTHORIZED", "UNKNOWN", "Cluster"]

PRODUCER = 0
PRODUCE = 0
"""The key of requests to take records."""
UNKNOWN, UNAUTHORIZED, STORAGE = 3, 29, 56
"""Errors of a broker: no such topic; no access to it; the disk is full."""


@cache
def _library() -> ctypes.CDLL:
    place = Path(str(package("confluent_kafka").__file__)).parent.parent / "confluent_kafka.libs"
    found = sorted(place.glob("librdkafka-*"))
    if not found:
        lacking("librdkafka", "confluent-kafka was not installed as a wheel")
    library = ctypes.CDLL(str(found[0]))
    pointer, integer, text = ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p
    for name, result, arguments in (
        ("rd_kafka_conf_new", pointer, ()),
        ("rd_kafka_conf_set", integer, (pointer, text, text, text, ctypes.c_size_t)),
        ("rd_kafka_new", pointer, (integer, pointer, text, ctypes.c_size_t)),
        ("rd_kafka_destroy", None, (pointer,)),
        ("rd_kafka_mock_cluster_new", pointer, (pointer, integer)),
        ("rd_kafka_mock_cluster_destroy", None, (pointer,)),
        ("rd_kafka_mock_cluster_bootstraps", text, (pointer,)),
        ("rd_kafka_mock_broker_set_down", integer, (pointer, integer)),
        ("rd_kafka_mock_broker_set_up", integer, (pointer, integer)),
        ("rd_kafka_mock_broker_set_rtt", integer, (pointer, integer, integer)),
        ("rd_kafka_mock_topic_set_error", None, (pointer, text, integer)),
        ("rd_kafka_mock_topic_create", integer, (pointer, text, integer, integer)),
        ("rd_kafka_mock_clear_request_errors", None, (pointer, ctypes.c_int16)),
        (
            "rd_kafka_mock_push_request_errors_array",
            None,
            (pointer, ctypes.c_int16, ctypes.c_size_t, pointer),
        ),
    ):
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
    return library


class Cluster:
    """One broker on a port of this machine, up at once."""

    def __init__(self) -> None:
        library = self._library = _library()
        said = ctypes.create_string_buffer(512)
        conf = library.rd_kafka_conf_new()
        library.rd_kafka_conf_set(conf, b"log_level", b"2", said, 512)
        self._client = library.rd_kafka_new(PRODUCER, conf, said, 512)
        self._cluster = library.rd_kafka_mock_cluster_new(self._client, 1)
        self.port = int(library.rd_kafka_mock_cluster_bootstraps(self._cluster).decode().rpartition(":")[2])

    @property
    def address(self) -> str:
        return f"127.0.0.1:{self.port}"

    def down(self) -> None:
        """Cut all connections and take no new ones; what it has kept stays."""
        self._library.rd_kafka_mock_broker_set_down(self._cluster, 1)

    def up(self) -> None:
        """Be there again, on the same port."""
        self._library.rd_kafka_mock_broker_set_up(self._cluster, 1)

    def slow(self, seconds: float) -> None:
        """Answer so late [s]."""
        self._library.rd_kafka_mock_broker_set_rtt(self._cluster, 1, round(seconds * 1000))

    def refuse(self, topic: str, error: int) -> None:
        """Answer with an error whenever it is asked for a topic; 0 ends that."""
        self._library.rd_kafka_mock_topic_set_error(self._cluster, topic.encode(), error)

    def take_nothing(self, errors: Sequence[int]) -> None:
        """Answer with these errors to the next records, one for each request."""
        array = (ctypes.c_int * len(errors))(*errors)
        self._library.rd_kafka_mock_push_request_errors_array(self._cluster, PRODUCE, len(errors), array)

    def take_all(self) -> None:
        """Take records again."""
        self._library.rd_kafka_mock_clear_request_errors(self._cluster, PRODUCE)

    def close(self) -> None:
        self._library.rd_kafka_mock_cluster_destroy(self._cluster)
        self._library.rd_kafka_destroy(self._client)
