"""Topics as programs on roslibpy and roslib meet them."""

from __future__ import annotations

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import BatteryState
from tests.bridge.wires import Record, server
from tests.clients.peers import BOTH, both, peer

STRING = {"name": "/chat", "type": "std_msgs/String"}
GRIPPER = {"name": "/gripper", "type": "acme_msgs/Gripper"}
VELOCITY = {"name": "/cmd_vel", "type": "geometry_msgs/Twist"}
ODOMETRY = {"name": "/odom", "type": "nav_msgs/Odometry"}


@pytest.mark.parametrize(
    ("library", "transport"), [("roslibpy", "asyncio"), ("roslibpy", "twisted"), ("roslib", "")]
)
async def test_what_the_robot_tells_arrives(library, transport):
    async with server() as robot, peer(library, robot.port, transport) as client:
        await client.do("subscribe", **ODOMETRY)
        await client.settled()
        robot.publish("/odom", Odometry(child_frame_id="base_link"))
        heard = await client.message("/odom")
        assert (heard["child_frame_id"], heard["pose"]["covariance"]) == ("base_link", [0] * 36)


@pytest.mark.parametrize(
    ("library", "transport"), [("roslibpy", "asyncio"), ("roslibpy", "twisted"), ("roslib", "")]
)
async def test_what_a_client_commands_arrives(library, transport):
    heard = Record()
    async with server(on_message=heard) as robot, peer(library, robot.port, transport) as client:
        await client.do("publish", **VELOCITY, msg={"linear": {"x": 0.25}, "angular": {"z": -1}})
        ((_, topic, msg, stamp),) = await heard.reach(1)
        assert (topic, msg, stamp) == ("/cmd_vel", Twist.planar(0.25, -1.0), None)


@BOTH
async def test_what_was_told_before_arrives_on_subscribing_when_it_is_latched(library):
    async with server() as robot, peer(library, robot.port) as client:
        robot.publish("/robot/info", RobotInfo(name="Patrol-1"))
        await client.do("subscribe", name="/robot/info", type="pilothouse_msgs/RobotInfo")
        assert (await client.message("/robot/info"))["name"] == "Patrol-1"


@BOTH
async def test_what_is_not_known_arrives_as_null(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("subscribe", name="/battery_state", type="sensor_msgs/BatteryState")
        await client.settled()
        robot.publish("/battery_state", BatteryState(percentage=0.5))
        heard = await client.message("/battery_state")
        assert (heard["percentage"], heard["current"]) == (0.5, None)


@BOTH
async def test_who_unsubscribed_hears_nothing_more(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("subscribe", **ODOMETRY)
        await client.do("unsubscribe", **ODOMETRY)
        await client.settled()
        robot.publish("/odom", Odometry())
        await client.settled()
        assert client.of("message") == []


@BOTH
async def test_a_throttled_subscriber_gets_the_newest_when_its_time_has_come(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("subscribe", **ODOMETRY, throttle_rate=300, queue_length=1)
        await client.settled()
        robot.publish("/odom", Odometry(child_frame_id="first"))
        await client.message("/odom")
        for name in ("second", "third"):
            robot.publish("/odom", Odometry(child_frame_id=name))
        await client.message("/odom", 2)
        told = [event["msg"]["child_frame_id"] for event in client.of("message")]
        assert told == ["first", "third"]


@pytest.mark.parametrize(
    ("topic", "said"),
    [
        (STRING, {"data": "Grüße, \U0001f916"}),
        (GRIPPER, {"fingers": [{"name": "left", "force": 1.5}], "raw": [-3, 512]}),
    ],
    ids=["known type", "unknown type"],
)
async def test_what_one_client_publishes_the_other_hears_and_back(topic, said):
    async with server() as robot, both(robot.port) as (python, script):
        for client in (python, script):
            await client.do("subscribe", **topic)
            await client.settled()
        await python.do("publish", **topic, msg=said)
        assert await script.message(topic["name"]) == said
        await script.do("publish", **topic, msg=said)
        assert await python.message(topic["name"], 2) == said


async def test_a_message_between_clients_is_filled_up_to_its_type():
    async with server() as robot, both(robot.port) as (python, script):
        await script.do("subscribe", name="/where", type="geometry_msgs/Point")
        await script.settled()
        await python.do("publish", name="/where", type="geometry_msgs/Point", msg={"x": 1})
        assert await script.message("/where") == {"x": 1, "y": 0, "z": 0}


@pytest.mark.parametrize("first", [0, 1])
async def test_what_a_client_latches_later_ones_hear_too(first):
    async with server() as robot, both(robot.port) as pair:
        early, late = pair[first], pair[1 - first]
        await early.do("publish", **STRING, latch=True, msg={"data": "kept"})
        await early.settled()
        await late.do("subscribe", **STRING)
        assert await late.message("/chat") == {"data": "kept"}


@BOTH
async def test_a_topic_of_a_clients_is_gone_with_it(library):
    async with server() as robot, peer("roslib", robot.port) as looking:
        async with peer(library, robot.port, leaves=True) as client:
            await client.do("advertise", **STRING)
            await client.settled()
            assert "/chat" in (await looking.ask("getTopics"))["topics"]
        await looking.gone("/chat")


@BOTH
async def test_a_client_cannot_speak_for_the_robot(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("subscribe", **ODOMETRY)
        await client.do("publish", **ODOMETRY, msg={"child_frame_id": "forged"})
        await client.settled()
        assert client.of("message") == []


@BOTH
async def test_ids_may_be_numbers(library):
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("subscribe", **ODOMETRY)
        for id in (0, 7):
            await client.do("say", op={"op": "subscribe", "id": id, "topic": "/odom"})
        await client.do("say", op={"op": "unsubscribe", "id": 7, "topic": "/odom"})
        await client.settled()
        robot.publish("/odom", Odometry())
        await client.settled()
        assert len(client.of("message")) == 1


@BOTH
async def test_nobody_is_told_of_mistakes_who_did_not_ask(library):
    """A `status` makes roslibpy complain; `peer` fails the test when it does."""
    async with server() as robot, peer(library, robot.port) as client:
        await client.do("say", op={"op": "fly"})
        await client.do("say", op={"op": "publish", "topic": "/cmd_vel", "msg": {"linear": 3}})
        await client.do("say", op={"op": "subscribe"})
        await client.do("say", op={"op": "unsubscribe", "topic": "/nowhere", "id": "x"})
        await client.settled()
        assert client.of("status") == []


async def test_who_asked_is_told_which_operation_was_wrong():
    async with server() as robot, peer("roslib", robot.port) as client:
        await client.do("level", level="error")
        await client.do("say", op={"op": "publish", "id": "p7", "topic": "/cmd_vel", "msg": {"linear": 3}})
        await client.do("say", op={"op": "fly"})
        await client.event("status", "error")
        await client.do("hear", name="status:p7")
        await client.do("say", op={"op": "publish", "id": "p7", "topic": "/cmd_vel", "msg": {"angular": 3}})
        assert "publish" in (await client.event("heard", "status:p7"))["msg"]["msg"]
