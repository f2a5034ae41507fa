"""Names of Kafka topics, and what the headers of a record ask for."""

from __future__ import annotations

import re

import pytest

from bridge.core.errors import BridgeError, Refused
from bridge.core.topics import TOPICS
from robotside.gateways.kafka.topic_names import MAX_HEADER, Asked, TopicNames, client_of, read_headers

MAX_TOPIC = 249
"""Characters of a topic, by Kafka."""


def test_topics_have_names_that_kafka_can_have() -> None:
    names = TopicNames("", "Rex the 1st/+#.ü")
    assert names.root == "pilothouse.Rex-the-1st"
    assert names.topic("/camera/image/compressed") == f"{names.root}.topics.camera.image.compressed"
    assert TopicNames("lab_1.hall", "/").root == "lab_1.hall.robot"
    long = TopicNames("p" * 64, "r" * 500)
    for name in (*(each.name for each in TOPICS), "/temperature/left front/ü", "/x" * 300):
        assert re.fullmatch(r"[A-Za-z0-9._-]+", long.topic(name))
        assert len(long.topic(name)) <= MAX_TOPIC
    assert len({names.topic(each.name) for each in TOPICS}) == len(TOPICS)


@pytest.mark.parametrize("prefix", ["a/b", "ü", "p" * 65, "a b"])
def test_a_prefix_that_kafka_cannot_have_is_one_sentence(prefix: str) -> None:
    with pytest.raises(BridgeError, match="prefix of Kafka topics has 1 to 64 letters"):
        TopicNames(prefix, "Rex")


def test_headers_say_what_is_asked_for_and_those_of_others_are_passed_over() -> None:
    headers = [
        ("call", b"/arm/move"),
        ("stamp", b"1.5"),
        ("token", b"t"),
        ("id", b"7"),
        ("traceparent", b"\xff"),
    ]
    assert read_headers(headers) == Asked("call", "/arm/move", "1.5", "t", b"7")
    assert read_headers([("bye", None)]) == Asked("bye", "", None, "", b"")


@pytest.mark.parametrize(
    ("headers", "why"),
    [
        ([], "one header of publish"),
        ([("call", b"/a"), ("run", b"/b")], "one header of publish"),
        ([("call", b"/a"), ("call", b"/b")], "there twice"),
        ([("call", b"a")], "a slash before it, as in /arm/move, not 'a'"),
        ([("call", None)], "a slash before it"),
        ([("call", b"/a"), ("token", b"\xff")], "token is not a text"),
        ([("call", b"/a"), ("id", b"x" * (MAX_HEADER + 1))], "id has at most 1024 bytes, not 1025"),
    ],
)
def test_headers_that_cannot_be_read_are_one_sentence(
    headers: list[tuple[str, bytes | None]], why: str
) -> None:
    with pytest.raises(Refused, match=why):
        read_headers(headers)


def test_a_key_is_the_name_of_a_client_that_can_be_shown() -> None:
    assert client_of("Anna Bö".encode()) == "Anna Bö"
    for key in (None, b"", b"\xff", b"a\nb", b"x" * 65):
        assert client_of(key) == ""
