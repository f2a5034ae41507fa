"""What one client may ask for, and for how long at a time: the clock is the test's, the writer a double."""

from __future__ import annotations

import asyncio
import json

import pytest

from bridge.core.compat import Compat
from bridge.core.topics import TOPICS
from bridge.msgs.nav_msgs import Odometry
from bridge.protocol import ServerSession, split
from bridge.protocol.merging import merged
from bridge.server.client_services import ClientServices
from bridge.server.flow.message_reducing import MessageReducer
from bridge.server.flow.send_queue import TURN_TIME, WriteBatch
from bridge.server.rosapi.parameters import Parameters
from bridge.server.rosapi.services import Graph, RosApi
from bridge.server.rosbridge_session import RosbridgeSession
from bridge.server.server_context import ServerContext
from bridge.server.switchboard import Switchboard
from bridge.server.topic_operations import MAX_READ_BYTES
from robotside.door.calls_in_progress import MAX_CALLS
from robotside.door.door import URGENT, Door
from tests.bridge.server.flow.test_send_queue import FrameWriter
from tests.bridge.wires import Clock, Record, service


async def never(session, request):
    await asyncio.Event().wait()


class House:
    """A server without a network; `join` gives a client of it."""

    def __init__(self, *services, on_message=None):
        self.clock, self.soon, self.heard = Clock(), [], Record()
        offered = services or (service("/stop"), service("/slow", never))
        self.door = door = Door(services=offered, on_message=on_message or self.heard)
        client_services = ClientServices(door.services, {})
        self.switchboard = Switchboard(TOPICS, lambda *_: None)
        self.context = ServerContext(
            switchboard=self.switchboard,
            door=door,
            client_services=client_services,
            rosapi=RosApi(Graph(dict, dict, dict, dict), Parameters(), self.clock),
            reducer=MessageReducer(),
            compat=Compat(),
            now=self.clock,
        )

    def join(self):
        writer = FrameWriter()
        batch = WriteBatch(lambda call: self.soon.append(call))  # noqa: PLW0108 -- `soon` is another list after each step
        client = RosbridgeSession(writer, batch, self.door.join("somebody"), self.context)
        client._clock = self.clock
        return client, writer

    def step(self):
        soon, self.soon = self.soon, []
        for call in soon:
            call()


def said(*ops):
    return "".join(json.dumps(op) for op in ops)


def called(name, id):
    return {"op": "call_service", "service": name, "id": id}


async def test_a_frame_that_takes_longer_than_its_turn_waits_for_the_next_one():
    order = []

    def slow(session, topic, msg, stamp):
        order.append(msg.linear.x)
        house.clock.time += 1.1 * TURN_TIME

    house = House(on_message=slow)
    client, _ = house.join()
    frame = [{"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": float(x)}}} for x in range(5)]
    assert not client.on_message(said(*frame))
    assert order == [0.0]
    assert not client.on_message(said(frame[0] | {"msg": {"linear": {"x": 9.0}}}))
    assert [client.resume() for _ in range(5)] == [False] * 4 + [True]
    assert order == [0.0, 1.0, 2.0, 3.0, 4.0, 9.0]
    assert client.on_message(said(frame[0]))
    await client.close()


async def test_what_a_client_left_undone_is_not_done_when_it_is_gone():
    house = House(on_message=lambda *_: setattr(house.clock, "time", house.clock.time + TURN_TIME))
    client, _ = house.join()
    frame = [{"op": "publish", "topic": "/cmd_vel"}, {"op": "subscribe", "topic": "/odom"}]
    assert not client.on_message(said(*frame))
    await client.close()
    assert client.resume()
    assert not house.switchboard.wanted("/odom")


@pytest.mark.parametrize(
    "more",
    [
        [{"op": "set_level", "level": "none", "fragment_size": 100 + number % 2} for number in range(100)],
        [{"op": "unsubscribe", "topic": "/odom", "id": str(number)} for number in range(50)],
        [{"op": "subscribe", "topic": "/odom", "id": "7", "throttle_rate": number} for number in range(50)],
    ],
)
async def test_subscriptions_are_put_together_once_for_all_operations_of_a_frame(more, monkeypatch):
    house = House()
    client, _ = house.join()
    for number in range(100):
        client.on_message(
            said({"op": "subscribe", "topic": "/odom", "id": str(number), "throttle_rate": 1000})
        )
    times = Record()
    monkeypatch.setattr(
        "bridge.protocol.client_subscriptions.merged", lambda *all: (times(1), merged(*all))[1]
    )
    client.on_message(said(*more))
    assert len(times) == 1
    (stream,) = house.switchboard.channels["/odom"].streams.values()
    assert stream.form.fragment_size == client.protocol.subscriptions["/odom"].fragment_size
    assert stream.period == client.protocol.subscriptions["/odom"].period
    await client.close()


async def test_who_asks_again_gets_what_is_latched_once_and_as_it_asked_last():
    house = House()
    client, writer = house.join()
    client.on_message(said({"op": "subscribe", "topic": "/robot/info", "id": "1"}))
    house.switchboard.publish("/robot/info", house.switchboard.channels["/robot/info"].cls())
    house.step()
    writer.writes.clear()
    again = {"op": "subscribe", "topic": "/robot/info", "id": "1"}
    client.on_message(said(again, again | {"fragment_size": 50}))
    house.step()
    assert {json.loads(text)["op"] for text in writer.heard} == {"fragment"}
    assert sum(json.loads(text)["num"] == 0 for text in writer.heard) == 1
    await client.close()


async def test_a_client_may_have_so_many_calls_at_work_but_stop_is_always_heard():
    house = House()
    client, writer = house.join()
    for number in range(MAX_CALLS):
        client.on_message(said(called("/slow", number)))
        await asyncio.sleep(0)
    client.on_message(said(called("/slow", "one too many")))
    client.on_message(said(called("/stop", "stop")))
    house.step()
    told = {each["id"]: each for each in map(json.loads, writer.heard)}
    assert told["one too many"]["values"] == "256 calls of this client wait for their answer already."
    assert told["stop"]["values"]["success"] is True
    await client.close()


async def test_while_a_slow_stop_is_at_work_another_is_still_heard():
    house = House(service("/stop", never))
    client, writer = house.join()
    for number in range(MAX_CALLS + 1):
        client.on_message(said(called("/stop", number)))
        await asyncio.sleep(0)
    house.step()
    assert writer.heard == []
    await client.close()


@pytest.mark.parametrize("name", sorted(URGENT))
async def test_answers_about_stop_and_control_go_before_others_that_wait(name):
    house = House(service(name), service("/other"))
    client, writer = house.join()
    client.queue.window.sent += 1_000_000
    client.on_message(said(called("/other", "other"), called(name, "first")))
    house.step()
    assert [json.loads(text)["id"] for text in writer.heard] == ["first"]
    await client.close()


async def test_the_rest_of_fragments_that_does_not_come_is_waited_for_ten_seconds():
    house = House()
    client, writer = house.join()
    client.on_message(said({"op": "set_level", "level": "error"}))
    first, *_ = split(said({"op": "unsubscribe", "topic": "/a" * 20}).encode(), 20, "f")
    client.on_message(first)
    house.clock.time += 9.9
    client.check_alive()
    house.step()
    assert writer.heard == []
    house.clock.time += 0.2
    client.check_alive()
    house.step()
    (told,) = (json.loads(text) for text in writer.heard)
    assert (told["op"], told["id"]) == ("status", "f")
    assert "nothing more came within 10 s" in told["msg"]
    await client.close()


async def test_what_was_latched_by_who_never_advertised_does_not_stay():
    house = House()
    owner, _ = house.join()
    guest, _ = house.join()
    owner.on_message(said({"op": "advertise", "topic": "/chat", "type": "std_msgs/String"}))
    guest.on_message(said({"op": "publish", "topic": "/chat", "msg": {"data": "x"}, "latch": True}))
    assert house.switchboard.channels["/chat"].last == {}
    owner.on_message(said({"op": "publish", "topic": "/chat", "msg": {"data": "x"}, "latch": True}))
    assert list(house.switchboard.channels["/chat"].last) == [owner]
    guest.on_message(said({"op": "subscribe", "topic": "/chat"}))
    await owner.close()
    guest.on_message(said({"op": "publish", "topic": "/chat", "msg": {"data": "x"}, "latch": True}))
    assert house.switchboard.channels["/chat"].last == {}
    await guest.close()


async def test_nothing_is_sent_any_more_to_who_left_while_something_was_made_ready():
    house = House()
    client, _ = house.join()
    client.on_message(said({"op": "subscribe", "topic": "/odom"}))
    (stream,) = house.switchboard.channels["/odom"].streams.values()
    await client.close()
    assert stream.gone


async def test_a_subscription_that_is_refused_is_not_remembered():
    house = House()
    client, _ = house.join()
    client.on_message(said({"op": "subscribe", "topic": "/no/such", "id": "1"}))
    assert client.protocol.subscriptions == {}
    assert "/no/such" not in house.switchboard.channels
    await client.close()


async def test_a_large_message_is_passed_on_when_it_is_whole_and_not_mended_when_it_is_not():
    house = House()
    client, writer = house.join()
    client.on_message(said({"op": "set_level", "level": "error"}))
    client.on_message(said({"op": "advertise", "topic": "/chat", "type": "std_msgs/String"}))
    long = "x" * (MAX_READ_BYTES + 1)
    for msg in ({"data": long}, {"data": long, "more": 1}):
        client.on_message(said({"op": "publish", "topic": "/chat", "msg": msg}))
    house.step()
    (told,) = (json.loads(text) for text in writer.heard)
    assert "over 1048576 bytes must have all fields of std_msgs/String and no other" in told["msg"]
    await client.close()


async def test_what_is_wanted_otherwise_counts_from_the_next_message():
    house = House()
    client, writer = house.join()
    client.on_message(said({"op": "subscribe", "topic": "/odom"}, {"op": "set_level", "fragment_size": 200}))
    house.switchboard.publish("/odom", Odometry())
    house.step()
    assert {json.loads(text)["op"] for text in writer.heard} == {"fragment"}
    await client.close()


def test_types_have_names_of_bounded_length():
    session = ServerSession()
    for op in ("subscribe", "advertise"):
        (told,) = session.receive(said({"op": op, "topic": "/a", "type": "x" * 257}), 0.0)
        assert str(told) == "A type's name has at most 256 characters, not 257."
