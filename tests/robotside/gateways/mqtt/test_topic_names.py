"""Names of MQTT topics: what a client's topic asks for, and where it is answered."""

from __future__ import annotations

import pytest

from robotside.gateways.broker.command_desk import BYE, CALL, PUBLISH
from robotside.gateways.mqtt.topic_names import Asked, TopicNames

NAMES = TopicNames("", "Rex the 1st/+#")
MINE = f"{NAMES.root}/clients/me"


def test_a_robot_has_a_name_that_mqtt_can_have() -> None:
    assert NAMES.root == "pilothouse/Rex-the-1st"
    assert TopicNames("lab/robots", "/").root == "lab/robots/robot"


def test_commands_are_read_as_they_are_written() -> None:
    for client, verb, name in (("me", CALL, "/arm/move"), ("Anna B", PUBLISH, "/cmd_vel"), ("me", BYE, "")):
        assert NAMES.read(NAMES.command(client, verb, name)) == Asked(client, verb, name)


@pytest.mark.parametrize(
    "topic",
    [
        "",
        "me",
        "bye/now",
        "call",
        "call/",
        "me/fly",
        "me/call",
        "me/call/",
        "me/bye/x",
        "m\ne/call/stop",
        "m" * 65 + "/bye",
        "me/call/" + "x" * 257,
    ],
)
def test_what_is_no_command_is_none(topic: str) -> None:
    assert NAMES.read(f"{NAMES.root}/clients/{topic}") is None
    assert NAMES.read(topic) is None


def test_an_answer_goes_where_its_client_wants_it_below_its_own_answers() -> None:
    assert NAMES.answer("me", "/stop") == f"{MINE}/answer/stop"
    for own in (f"{MINE}/answer", f"{MINE}/answer/7/a"):
        assert NAMES.answer("me", "/stop", own) == own
    for other in (
        "x",
        f"{MINE}/call/stop",
        f"{MINE}/answers",
        f"{MINE}/answer/#",
        f"{NAMES.root}/clients/you/answer",
    ):
        assert NAMES.answer("me", "/stop", other) == f"{MINE}/answer/stop"
