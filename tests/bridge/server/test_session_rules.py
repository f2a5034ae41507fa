"""What a session refuses: on the reserve everything but STOP and the time, and at any place what the role is too small for."""

from __future__ import annotations

import json

import pytest

from bridge.server.flow.send_queue import WriteBatch
from bridge.server.reception.places import FULL, Limits, Places
from bridge.server.rosbridge_session import RosbridgeSession
from tests.bridge.server.flow.test_send_queue import FrameWriter
from tests.bridge.server.test_rosbridge_session import House, called, said
from tests.bridge.wires import service
from tests.robotside.door.test_gate import OneKeyEach

DRIVE = {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": 0.3}}}
ERRORS = {"op": "set_level", "level": "error"}


class Guarded(House):
    """A server whose door knows one person of each role, a STOP and something else to call."""

    def __init__(self):
        super().__init__(service("/stop"), service("/places/set"))
        self.door._gate = OneKeyEach()

    def come(self, token="", place=None):
        writer, batch = FrameWriter(), WriteBatch(lambda call: self.soon.append(call))  # noqa: PLW0108
        client = RosbridgeSession(writer, batch, self.door.join("somebody", token=token), self.context, place)
        client._clock = self.clock
        return client, writer

    def answers(self, client, writer, *ops):
        """What is sent in answer: results by id, and the sentences of errors."""
        client.on_message(said(ERRORS, *ops))
        self.step()
        told = [json.loads(text) for text in writer.heard]
        return (
            {each["id"]: each["values"] for each in told if each["op"] == "service_response"},
            [each["msg"] for each in told if each["op"] == "status"],
        )


def on_reserve():
    return Places(Limits(total=0, reserve=1)).arrive("192.0.2.1", lambda: None)


async def test_on_the_reserve_stop_and_the_time_are_answered_and_nothing_else_is_done():
    house = Guarded()
    client, writer = house.come("m", on_reserve())
    asked = [
        called("/stop", "stop"),
        called("/rosapi/get_time", "time"),
        called("/places/set", "place"),
        DRIVE,
        {"op": "subscribe", "topic": "/odom"},
    ]
    answers, errors = house.answers(client, writer, *asked)
    assert answers["stop"]["success"] is True
    assert answers["time"]["time"]["secs"] == 1000
    assert answers["place"] == FULL
    assert [error.endswith(FULL) for error in errors] == [True, True]
    assert house.heard == []
    assert not house.switchboard.wanted("/odom")
    await client.close()


async def test_who_has_a_place_drives():
    house = Guarded()
    client, writer = house.come("m")
    answers, errors = house.answers(client, writer, DRIVE, called("/places/set", "place"))
    assert answers["place"]["success"] is True
    assert errors == []
    assert len(house.heard) == 1
    await client.close()


async def test_only_a_question_for_the_time_shows_that_clocks_were_compared():
    house = Guarded()
    client, writer = house.come("m")
    house.answers(client, writer, called("/rosapi/topics", "topics"))
    assert not client.operator.asked_time
    house.answers(client, writer, called("/rosapi/get_time", "time"))
    assert client.operator.asked_time
    house.answers(client, writer, called("/rosapi/topics", "again"))
    assert client.operator.asked_time
    await client.close()


async def test_whatever_a_client_says_shows_that_it_is_there():
    house = Guarded()
    client, _ = house.come("m")
    for message in (said(ERRORS), "no JSON"):
        house.clock.time += 1.0
        client.on_message(message)
        assert client.operator.last_heard == house.clock.time
    await client.close()


async def test_nobody_speaks_where_the_robot_does():
    house = Guarded()
    client, writer = house.come("m")
    own = {"topic": "/odom", "type": "nav_msgs/Odometry"}
    _, errors = house.answers(client, writer, {"op": "advertise"} | own)
    assert errors == ["advertise: /odom is this robot's own topic."]
    await client.close()


@pytest.mark.parametrize(
    ("token", "op", "sentence"),
    [
        ("", {"op": "subscribe", "topic": "/odom"}, "pair with it first"),
        ("", DRIVE, "pair with it first"),
        ("w", DRIVE, "needs the role drive"),
        ("w", {"op": "publish", "topic": "/chat", "msg": {"data": "x"}}, "needs the role drive"),
        ("w", {"op": "advertise", "topic": "/mine", "type": "std_msgs/String"}, "needs the role drive"),
    ],
)
async def test_what_the_role_is_too_small_for_is_refused_and_not_done(token, op, sentence):
    house = Guarded()
    driver, heard = house.come("d")
    chat = {"topic": "/chat", "type": "std_msgs/String"}
    house.answers(driver, heard, {"op": "advertise"} | chat, {"op": "subscribe"} | chat)
    client, writer = house.come(token)
    _, errors = house.answers(client, writer, op)
    assert len(errors) == 1
    assert sentence in errors[0]
    assert (house.heard, heard.heard) == ([], [])
    assert not house.switchboard.wanted("/odom")
    assert not client.protocol.advertised
    for each in (client, driver):
        await each.close()
