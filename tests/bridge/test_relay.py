"""Clients that publish to each other through the server: real sockets, plain JSON."""

from __future__ import annotations

import json
import logging

import pytest

from bridge.core.topics import TOPICS, Topic
from bridge.msgs.std_msgs import String
from tests.bridge.peers import peer
from tests.bridge.wires import Record, server

CHATTER = {"topic": "/chatter", "type": "std_msgs/String"}


async def test_what_one_client_publishes_the_others_hear():
    async with server() as robot, peer(robot) as talker, peer(robot) as ear:
        await talker.say(op="advertise", **CHATTER)
        await talker.settled()
        await ear.say(op="subscribe", topic="chatter")
        await ear.settled()
        for word in ("one", "two"):
            await talker.say(op="publish", topic="/chatter", msg={"data": word})
        heard = [await ear.hear() for _ in range(2)]
        assert heard[0] == {"op": "publish", "topic": "chatter", "msg": {"data": "one"}}
        assert heard[1]["msg"]["data"] == "two"


async def test_missing_fields_take_their_defaults():
    async with server() as robot, peer(robot) as both:
        await both.say(op="advertise", topic="/t", type="geometry_msgs/msg/Twist")
        await both.say(op="subscribe", topic="/t")
        await both.say(op="publish", topic="/t", msg={"linear": {"x": 1}})
        assert (await both.hear())["msg"]["angular"] == {"x": 0, "y": 0, "z": 0}


async def test_a_message_that_does_not_fit_its_type_is_dropped_and_the_next_is_not():
    async with server() as robot, peer(robot) as both:
        await both.say(op="advertise", **CHATTER)
        await both.say(op="subscribe", topic="/chatter")
        await both.say(op="publish", topic="/chatter", msg={"data": 5})
        await both.say(op="publish", topic="/chatter", msg={"data": "good"})
        assert (await both.hear())["msg"] == {"data": "good"}


async def test_a_type_that_nobody_knows_is_passed_on_as_it_is():
    strange = {"a": [1, {"b": None}], "c": "ä"}
    async with server() as robot, peer(robot) as both, peer(robot) as binary:
        await both.say(op="advertise", topic="/own", type="my_msgs/Own")
        for ear, compression in ((both, "none"), (binary, "cbor")):
            await ear.say(op="subscribe", topic="/own", type="my_msgs/Own", compression=compression)
            await ear.settled()
        await both.say(op="publish", topic="/own", msg=strange)
        assert (await both.hear())["msg"] == strange
        assert (await binary.hear())["msg"] == strange


@pytest.mark.parametrize(
    "msg", ["5", "[1]", '"text"', "[" * 200 + "]" * 200, '{"a":' * 150 + "1" + "}" * 150]
)
async def test_what_others_could_not_read_is_not_passed_on(msg):
    async with server() as robot, peer(robot) as both:
        await both.say(op="advertise", topic="/own", type="my_msgs/Own")
        await both.say(op="subscribe", topic="/own")
        await both.ws.send('{"op":"publish","topic":"/own","msg":' + msg + "}")
        await both.settled()


async def test_a_latched_message_waits_for_who_comes_later_and_goes_with_its_publisher():
    async with server() as robot, peer(robot) as ear:
        async with peer(robot) as talker:
            await talker.say(op="advertise", latch=True, **CHATTER)
            for word in ("old", "new"):
                await talker.say(op="publish", topic="/chatter", msg={"data": word})
            await talker.settled()
            await ear.say(op="subscribe", **CHATTER)
            assert (await ear.hear())["msg"]["data"] == "new"
            await ear.say(op="unsubscribe", topic="/chatter")
            await ear.settled()
        while "/chatter" in (await ear.call("/rosapi/topics"))["values"]["topics"]:
            pass
        await ear.say(op="subscribe", **CHATTER)
        await ear.settled()


async def test_a_topic_is_there_as_long_as_somebody_needs_it():
    async def topics(foreign):
        return (await foreign.call("/rosapi/topics"))["values"]["topics"]

    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="advertise", id="a", **CHATTER)
        await foreign.say(op="advertise", id="b", **CHATTER)
        await foreign.say(op="unadvertise", topic="/chatter", id="a")
        assert "/chatter" in await topics(foreign)
        await foreign.say(op="unadvertise", topic="/chatter")
        assert "/chatter" not in await topics(foreign)


async def test_drive_commands_reach_the_robot_and_whoever_watches_them():
    heard = Record()
    async with server(on_message=heard) as robot, peer(robot) as driver, peer(robot) as ear:
        await ear.say(op="subscribe", topic="/cmd_vel")
        await ear.settled()
        await driver.say(op="publish", topic="/cmd_vel", latch=True, msg={"linear": {"x": 0.5}}, stamp=7.5)
        assert (await ear.hear())["msg"]["linear"]["x"] == 0.5
        assert (heard[0][1], heard[0][3]) == ("/cmd_vel", 7.5)
        await driver.say(op="subscribe", topic="/cmd_vel")
        await driver.settled()


@pytest.mark.parametrize("topic", [topic for topic in TOPICS if topic.to == "handheld"])
async def test_no_client_speaks_for_the_robot(topic: Topic):
    async with server() as robot, peer(robot) as liar, peer(robot) as ear:
        await ear.say(op="subscribe", topic=topic.name)
        await ear.settled()
        await liar.say(op="advertise", topic=topic.name, type=topic.type.MSGTYPE)
        await liar.say(op="publish", topic=topic.name, msg={})
        await liar.settled()
        await ear.settled()


async def test_a_slow_subscriber_of_a_chat_gets_the_last_hundred_and_costs_nobody_anything():
    async with server() as robot, peer(robot, max_queue=1) as slow, peer(robot) as quick:
        await quick.say(op="advertise", **CHATTER)
        for each in (slow, quick):
            await each.say(op="subscribe", topic="/chatter", type="std_msgs/String")
            await each.settled()
        slow.ws.transport.pause_reading()
        for number in range(300):
            await quick.say(op="publish", topic="/chatter", msg={"data": f"{number} {'x' * 20_000}"})
            assert (await quick.hear())["msg"]["data"].startswith(f"{number} ")
        slow.ws.transport.resume_reading()
        numbers = [-1]
        while numbers[-1] != 299:
            numbers.append(int((await slow.hear())["msg"]["data"].split()[0]))
        assert numbers == sorted(numbers)
        assert numbers[-100:] == list(range(200, 300))
        assert len(numbers) < 299


async def test_a_complaint_names_the_operation_and_its_id():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="set_level", level="error")
        await foreign.say(op="publish", topic="/nowhere", id="p7", msg={})
        remark = await foreign.hear()
        assert (remark["op"], remark["id"]) == ("status", "p7")
        assert remark["msg"].startswith('publish "p7": This robot does not listen to "/nowhere"')


async def test_the_same_complaint_is_logged_once_and_then_counted(caplog):
    caplog.set_level(logging.WARNING)
    async with server() as robot:
        async with peer(robot) as foreign:
            for number in range(50):
                await foreign.say(op="publish", topic=f"/nowhere{number}", id=number, msg={})
            await foreign.settled()
        async with peer(robot) as other:
            await other.settled()
    assert caplog.text.count("does not listen to") == 1
    assert "49 more of the same" in caplog.text


async def test_ten_thousand_subscriptions_are_bounded_and_cost_nobody_else_anything():
    async with server() as robot, peer(robot) as greedy, peer(robot) as quick:
        await greedy.say(op="set_level", level="error")
        for number in range(1001):
            await greedy.say(op="subscribe", topic=f"/t{number}", type="std_msgs/String")
        assert "at most 1000 subscriptions" in (await greedy.hear())["msg"]
        await quick.say(op="subscribe", topic="/events")
        await quick.settled()


async def test_several_subscriptions_of_a_client_are_one_delivery():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="advertise", **CHATTER)
        for id in ("a", "b"):
            await foreign.say(op="subscribe", topic="/chatter", id=id)
        await foreign.say(op="publish", topic="/chatter", msg={"data": "once"})
        assert (await foreign.hear())["msg"]["data"] == "once"
        await foreign.settled()


async def test_a_fragment_size_holds_for_everything_from_then_on():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="advertise", **CHATTER)
        await foreign.say(op="subscribe", topic="/chatter")
        await foreign.say(op="call_service", service="/rosapi/nodes", fragment_size=60)
        pieces = [await foreign.hear()]
        while len(pieces) < pieces[0]["total"]:
            pieces.append(await foreign.hear())
        whole = json.loads("".join(piece["data"] for piece in pieces))
        assert whole["service"] == "/rosapi/nodes"
        await foreign.say(op="publish", topic="/chatter", msg={"data": "x" * 100})
        assert (await foreign.hear())["op"] == "fragment"


async def test_operations_may_come_in_fragments():
    text = json.dumps({"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": 0.25}}})
    heard = Record()
    async with server(on_message=heard) as robot, peer(robot) as foreign:
        for num, data in reversed([(0, text[:30]), (1, text[30:])]):
            await foreign.say(op="fragment", id="f", num=num, total=2, data=data)
        assert (await heard.reach(1))[0][2].linear.x == 0.25


async def test_a_published_message_need_not_be_advertised_where_the_topic_is_there():
    async with server() as robot, peer(robot) as ear, peer(robot) as talker:
        await ear.say(op="subscribe", **CHATTER)
        await ear.settled()
        await talker.say(op="publish", topic="/chatter", msg={"data": "hello"})
        assert (await ear.hear())["msg"] == {"data": String("hello").data}


async def test_a_topic_that_the_robot_does_not_offer_is_not_told_of_and_stays_its_own():
    async with server(offers=lambda topic: topic != "/arm") as robot, peer(robot) as foreign:
        told = (await foreign.call("/rosapi/topics"))["values"]["topics"]
        assert "/odom" in told
        assert "/arm" not in told
        node = (await foreign.call("/rosapi/node_details", args={"node": "/pilothouse"}))["values"]
        assert "/odom" in node["publishing"]
        assert "/arm" not in node["publishing"]
        await foreign.say(op="subscribe", topic="/arm", type="pilothouse_msgs/ArmState")
        await foreign.say(op="set_level", level="error")
        await foreign.say(op="advertise", topic="/arm", type="pilothouse_msgs/ArmState")
        assert "own topic" in (await foreign.hear())["msg"]
        assert "/arm" not in (await foreign.call("/rosapi/topics"))["values"]["topics"]
