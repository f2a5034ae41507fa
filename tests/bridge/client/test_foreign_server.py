"""Our client on a server that is not ours, in the manners of ROS 1 and of ROS 2; first that server's own manners."""

from __future__ import annotations

import asyncio
import json
import math
import queue
from contextlib import asynccontextmanager, contextmanager

import cbor2
import pytest
from websockets.asyncio.client import connect

from bridge.client.client import Phase
from bridge.client.connection import Connection
from bridge.client.remote_robot import RemoteRobot
from bridge.core.errors import NoReply, ProtocolError, Refused
from bridge.core.network_thread import NetworkThread
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandResponse
from bridge.msgs.sensor_msgs import BatteryState, CompressedImage, Imu, LaserScan
from tests.bridge.client.foreign_server import ForeignServer, foreign
from tests.bridge.foreign_robot import PERIODS
from tests.bridge.wires import TIMEOUT, Record, link, wire

BOTH = pytest.mark.parametrize("ros", [1, 2])


class Told(Msg, frozen=True):
    """What std_srvs/Trigger answers."""

    MSGTYPE = "std_srvs/TriggerResponse"
    success: bool = False
    message: str = ""


class On(Msg, frozen=True):
    """What std_srvs/SetBool is asked."""

    MSGTYPE = "std_srvs/SetBoolRequest"
    data: bool = False


@asynccontextmanager
async def linked(ros=1, **options):
    async with foreign(ros, **options) as robot, link(f"ws://127.0.0.1:{robot.port}") as far:
        yield robot, await far.connected()


class Stranger:
    """A bare WebSocket on the foreign server."""

    def __init__(self, ws):
        self.ws = ws

    async def say(self, **op):
        await self.ws.send(json.dumps(op))

    async def hear(self):
        async with asyncio.timeout(TIMEOUT):
            return await self.ws.recv()

    async def call(self, service, **more):
        await self.say(op="call_service", service=service, id="c", **more)
        return json.loads(await self.hear())


@asynccontextmanager
async def stranger(ros=1):
    async with (
        foreign(ros) as robot,
        connect(f"ws://127.0.0.1:{robot.port}", proxy=None, compression=None, close_timeout=0.1) as ws,
    ):
        yield robot, Stranger(ws)


# Its manners


async def test_its_ros_1_escapes_slashes_and_counts_fragments_in_floats_from_number_0():
    async with stranger() as (_, peer):
        await peer.say(op="subscribe", topic="/robot_description", type="std_msgs/String", fragment_size=40)
        first = await peer.hear()
        heard = json.loads(first)
        assert "\\/" in first
        assert (heard["op"], heard["id"], heard["num"]) == ("fragment", 0, 0)
        assert heard["total"] != int(heard["total"])


@pytest.mark.parametrize(
    "op",
    [
        {"op": "set_level", "level": "info"},
        {"op": "fly"},
        {"op": "publish", "topic": "/nowhere", "msg": {}},
        {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": "fast"}}},
        {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": None}}},
        {"op": "publish", "topic": "/cmd_vel", "msg": {"warp": 9}},
        {"op": "subscribe", "topic": "/nowhere"},
        {"op": "subscribe", "topic": "/robot_description", "fragment_size": None},
        {"op": "advertise", "topic": "/cmd_vel", "type": "geometry_msgs/msg/Twist"},
        {"op": "advertise", "topic": "/info", "type": "pilothouse_msgs/RobotInfo"},
        {"op": "advertise_action", "action": "/dock", "type": "acme_msgs/Dock"},
    ],
)
async def test_its_ros_1_drops_what_is_wrong_without_a_word(op):
    async with stranger() as (robot, peer):
        await peer.say(**op)
        answer = await peer.call("/rosapi/get_time")
        assert answer["op"] == "service_response"
        assert robot.robot.heard == 0


async def test_what_a_publisher_leaves_out_takes_its_default():
    async with stranger() as (robot, peer):
        await peer.say(op="publish", topic="/cmd_vel", msg={"linear": {"x": 1}})
        await peer.call("/rosapi/get_time")
        assert (robot.robot.speed, robot.robot.turn) == (1.0, 0.0)


async def test_its_ros_1_loses_messages_with_fixed_arrays_in_cbor():
    async with stranger() as (robot, peer):
        await peer.say(op="subscribe", topic="/odom", type="nav_msgs/Odometry", compression="cbor")
        await peer.say(op="subscribe", topic="/scan", type="sensor_msgs/LaserScan", compression="cbor")
        assert (await peer.call("/rosapi/get_time"))["result"]
        robot.publish("/odom", "nav_msgs/Odometry", {})
        robot.publish("/scan", "sensor_msgs/LaserScan", {"ranges": [1.0]})
        heard = cbor2.loads(await peer.hear())
        assert (heard["topic"], heard["msg"]["ranges"].tag) == ("/scan", 85)


async def test_a_clients_service_that_refuses_looks_like_success():
    async with stranger() as (_, peer):
        await peer.say(op="advertise_service", service="/mine", type="std_srvs/Trigger")
        await peer.say(op="call_service", service="/mine", id="c")
        asked = json.loads(await peer.hear())
        assert asked["id"].startswith("service_request:/mine:")
        await peer.say(
            op="service_response", service="/mine", id=asked["id"], values={"success": False}, result=False
        )
        answer = json.loads(await peer.hear())
        assert (answer["id"], answer["result"], answer["values"]) == ("c", True, {"success": False})


@BOTH
async def test_a_clients_answer_that_is_a_sentence_is_dropped(ros):
    async with stranger(ros) as (_, peer):
        await peer.say(op="advertise_service", service="/mine", type="std_srvs/Trigger")
        await peer.say(op="call_service", service="/mine", id="c")
        asked = json.loads(await peer.hear())
        no = {"values": "It is shut.", "result": False}
        await peer.say(op="service_response", service="/mine", id=asked["id"], **no)
        assert (await peer.call("/beep"))["values"]["message"] == "beep"


@pytest.mark.parametrize(("ros", "expected"), [(1, False), (2, True)])
async def test_only_ros_2_tells_its_version(ros, expected):
    async with stranger(ros) as (_, peer):
        assert (await peer.call("/rosapi/get_ros_version"))["result"] is expected


async def test_a_type_of_its_own_is_told_with_all_it_is_made_of():
    async with stranger() as (_, peer):
        answer = await peer.call("/rosapi/message_details", args={"type": "acme_msgs/Gripper"})
        told = {typedef["type"]: typedef for typedef in answer["values"]["typedefs"]}
        assert set(told) >= {"acme_msgs/Gripper", "acme_msgs/Finger", "std_msgs/Header", "time", "duration"}
        assert told["acme_msgs/Gripper"]["fieldarraylen"] == [-1, -1, 0, -1, 3, 0, -1]
        unknown = await peer.call("/rosapi/message_details", args={"type": "acme_msgs/Nothing"})
        assert (unknown["result"], type(unknown["values"])) == (False, str)


async def test_its_ros_2_counts_for_whoever_sends_a_goal_until_it_is_cancelled():
    async with stranger(2) as (_, peer):
        goal = {
            "action": "/fibonacci",
            "action_type": "example_interfaces/action/Fibonacci",
            "feedback": True,
        }
        await peer.say(op="send_action_goal", id="g", args={"order": 500}, **goal)
        assert json.loads(await peer.hear())["op"] == "action_feedback"
        await peer.say(op="cancel_action_goal", id="g", action="/fibonacci")
        while (heard := json.loads(await peer.hear()))["op"] == "action_feedback":
            pass
        assert (heard["op"], heard["status"], heard["id"]) == ("action_result", 5, "g")


# Our client on it


@BOTH
async def test_every_topic_of_the_robot_arrives_typed(ros, monkeypatch):
    monkeypatch.setitem(PERIODS, "/battery_state", (0.05, "sensor_msgs/BatteryState"))
    wanted = {
        "/odom": Odometry,
        "/scan": LaserScan,
        "/imu/data": Imu,
        "/battery_state": BatteryState,
        "/camera/rgb/image_raw/compressed": CompressedImage,
    }
    async with linked(ros) as (_, client):
        heard = {name: Record() for name in wanted}
        for name, kind in wanted.items():
            client.subscribe(name, kind, heard[name])
        messages = {name: (await record.reach(1))[0][0] for name, record in heard.items()}
        assert messages["/odom"].child_frame_id == "base_footprint"
        assert messages["/odom"].header.stamp.seconds > 1e9
        assert messages["/scan"].ranges[90] == pytest.approx(6.0)
        assert messages["/imu/data"].linear_acceleration.z == 9.81
        assert math.isnan(messages["/battery_state"].current)
        assert messages["/camera/rgb/image_raw/compressed"].data[:2] == b"\xff\xd8"


@BOTH
async def test_driving_moves_the_robot_and_its_odometry_tells(ros):
    async with linked(ros) as (robot, client):
        heard = Record()
        client.subscribe("/odom", Odometry, lambda msg, _: heard(msg.pose.pose.position.x))
        client.advertise("/cmd_vel", Twist)
        await heard.reach(1)
        assert client.publish("/cmd_vel", Twist.planar(0.5, 0.0))
        await heard.until(lambda seen: seen[-1] > 0.02)
        assert robot.robot.heard == 1


@BOTH
async def test_its_services_answer_and_what_it_has_not_is_refused_in_its_own_words(ros):
    async with linked(ros) as (robot, client):
        assert await client.call("/beep", None, Told) == Told(success=True, message="beep")
        answer = await client.call("/enable_motors", On(data=False), Told)
        assert (answer.message, robot.robot.motors) == ("motors off", False)
        with pytest.raises(Refused, match="Service /stop does not exist"):
            await client.call("/stop", None, CommandResponse)


async def test_to_ros_2_types_are_named_as_it_names_them():
    async with linked(2) as (robot, client):
        client.subscribe("/odom", Odometry, Record())
        client.advertise("/cmd_vel", Twist)
        await client.call("/beep", None, Told)
        (peer,) = robot.peers
        types = {op["topic"]: op["type"] for op in peer.heard if op["op"] in ("subscribe", "advertise")}
        assert types == {"/odom": "nav_msgs/msg/Odometry", "/cmd_vel": "geometry_msgs/msg/Twist"}


async def test_to_ros_1_no_type_is_named_as_ros_2_does():
    async with linked(1) as (robot, client):
        client.subscribe("/odom", Odometry, Record())
        client.advertise("/cmd_vel", Twist)
        await client.call("/beep", None, Told)
        (peer,) = robot.peers
        assert {op["type"] for op in peer.heard if "type" in op} == {
            "nav_msgs/Odometry",
            "geometry_msgs/Twist",
        }


@pytest.mark.parametrize("compression", ["png", "cbor", "cbor-raw"])
async def test_a_laser_sweep_arrives_in_every_form(compression):
    async with linked() as (_, client):
        heard = Record()
        client.subscribe("/scan", LaserScan, heard, compression=compression)
        (sweep, _) = (await heard.reach(1))[0]
        assert len(sweep.ranges) == 180
        assert sweep.ranges[90] == pytest.approx(6.0)


async def test_what_comes_in_fragments_with_its_float_totals_is_put_together():
    async with linked() as (robot, client):
        for peer in robot.peers:
            peer.fragment_size = 300
        heard = Record()
        client.subscribe("/odom", Odometry, heard)
        assert (await heard.reach(2))[0][0].child_frame_id == "base_footprint"


async def test_after_the_server_was_restarted_everything_flows_again_and_nothing_old_arrives():
    async with foreign() as first, link(f"ws://127.0.0.1:{first.port}") as far:
        client = await far.connected()
        heard = Record()
        client.subscribe("/odom", Odometry, heard)
        client.advertise("/cmd_vel", Twist)
        await heard.reach(1)
        port = first.port
        await first.close()
        await far.sentence(Phase.WAITING)
        assert not client.publish("/cmd_vel", Twist.planar(0.5, 0.0))
        heard.clear()
        async with foreign(port=port) as second:
            await heard.reach(1)
            assert second.robot.heard == 0
            assert client.publish("/cmd_vel", Twist.planar(0.5, 0.0))
            await heard.until(lambda _: second.robot.heard == 1)


async def test_a_server_that_answers_nothing_but_pings_is_a_robot_that_does_not_tell_its_time(monkeypatch):
    monkeypatch.setattr("bridge.client.liveness.SILENCE_TIMEOUT", 0.2)
    monkeypatch.setattr("bridge.client.heartbeat.PING_PERIOD", 0.02)
    async with foreign() as robot:
        robot.deaf = True
        async with link(f"ws://127.0.0.1:{robot.port}") as far:
            expected = f"Connected to 127.0.0.1:{robot.port}, which does not report its time."
            assert await far.sentence(Phase.CONNECTED) == expected


async def test_a_frozen_line_is_lost_and_heals():
    async with foreign() as robot, wire(robot.port) as line, link(f"ws://127.0.0.1:{line.port}") as far:
        client = await far.connected()
        heard = Record()
        client.subscribe("/odom", Odometry, heard)
        await heard.reach(1)
        line.cut()
        await far.sentence(Phase.WAITING)
        heard.clear()
        await heard.reach(1)


async def test_a_client_that_never_answers_for_its_service_costs_the_caller_its_patience_only():
    async def never(request):
        await asyncio.Event().wait()

    async with linked() as (_, client):
        client.serve("/dead", "std_srvs/Trigger", never)
        with pytest.raises(NoReply):
            await client.call("/dead", None, Told, timeout=0.1)
        assert (await client.call("/beep", None, Told)).message == "beep"


@contextmanager
def apart(ros):
    """A foreign server in a thread of its own."""
    thread = NetworkThread("foreign server")
    robot = ForeignServer(ros)
    thread.start(robot.start()).result(TIMEOUT)
    try:
        yield robot
    finally:
        thread.start(robot.close()).result(TIMEOUT)
        thread.close()


@BOTH
def test_the_ten_lines_work_on_it(ros):
    seen = queue.Queue()
    with apart(ros) as robot, RemoteRobot(f"ws://127.0.0.1:{robot.port}") as remote:
        remote.wait()
        remote.on("/odom", seen.put)
        remote.publish("/cmd_vel", Twist.planar(0.4, 0.0))
        assert isinstance(seen.get(timeout=TIMEOUT), Odometry)
        assert remote.call("/beep", response=Told).message == "beep"
        assert remote.call("/beep").message == "beep"
        assert "topics" in remote.call("/rosapi/topics"), "no success that the answer does not say"
        assert robot.robot.heard == 1


def test_zero_that_a_full_socket_does_not_take_is_tried_until_it_does(monkeypatch):
    commands, tries = queue.Queue(), iter([False, True, True, True])
    with apart(1) as robot, RemoteRobot(f"ws://127.0.0.1:{robot.port}") as remote:
        robot.robot.command = commands.put
        remote.wait()
        monkeypatch.setattr(Connection, "full", property(lambda _: next(tries, False)))
        remote.publish("/cmd_vel", Twist.planar(0.4, 0.0))
        assert [commands.get(timeout=TIMEOUT)["linear"]["x"] for _ in range(2)] == [0.4, 0.0]
        assert list(tries) == []


@BOTH
async def test_a_type_that_nobody_knows_here_is_learned_from_it(ros):
    async with linked(ros) as (_, client):
        kind = await client.learn("acme_msgs/Gripper")
        heard = Record()
        client.subscribe("/gripper", kind, heard)
        message, _ = (await heard.reach(1))[0]
        assert kind.MSGTYPE == "acme_msgs/Gripper"
        assert (message.MODE_CLOSED, message.mode, message.fingers[1].name) == (1, 1, "right")
        assert (list(message.limits), list(message.raw)) == ([0.0, 0.08, 40.0], [-3, 512])
        assert message.header.stamp.seconds > 1e9


@BOTH
async def test_a_type_that_it_does_not_know_is_refused_in_its_words(ros):
    async with linked(ros) as (_, client):
        with pytest.raises((Refused, ProtocolError), match="no type acme_msgs/Nothing"):
            await client.learn("acme_msgs/Nothing")


@BOTH
async def test_a_service_offered_to_it_is_called_and_may_refuse(ros):
    def open_door(request):
        if not request.data:
            raise Refused("It is shut already.")
        return Told(success=True, message="open")

    async with linked(ros) as (robot, client), link(f"ws://127.0.0.1:{robot.port}") as far:
        other = await far.connected()
        client.serve("/door", "std_srvs/SetBool", open_door, request=On)
        await client.call("/beep", None, Told)
        assert (await other.call("/door", On(data=True), Told)).message == "open"
        shut = await other.call("/door", On(data=False), Told)  # all that such a server lets through
        assert shut == Told(success=False, message="It is shut already.")


class FibonacciGoal(Msg, frozen=True):
    """How many numbers."""

    MSGTYPE = "example_interfaces/FibonacciGoal"
    ROSTYPES = ("int32",)
    order: int = 0


class Numbers(Msg, frozen=True):
    """The numbers so far."""

    MSGTYPE = "example_interfaces/FibonacciResult"
    ROSTYPES = ("int32[]",)
    sequence: list[int] = []


def fibonacci(client, order, heard):
    goal = FibonacciGoal(order=order)
    return client.goal("/fibonacci", goal, on_feedback=heard, result=Numbers, feedback=Numbers)


async def test_its_actions_tell_how_far_they_are_and_what_came_of_them():
    async with linked(2) as (_, client):
        heard = Record()
        result = await fibonacci(client, 5, heard).result()
        assert result.sequence == [0, 1, 1, 2, 3, 5]
        assert [len(told.sequence) for told in heard] == [3, 4, 5, 6]


async def test_a_goal_that_is_taken_back_ends_on_the_robot_too():
    async with linked(2) as (robot, client):
        heard = Record()
        goal = fibonacci(client, 500, heard)
        await heard.reach(1)
        goal.cancel()
        with pytest.raises(Refused):
            await goal.result()
        assert not robot.counting


async def test_an_action_on_ros_1_is_given_up_by_time():
    async with linked(1) as (_, client):
        with pytest.raises((NoReply, Refused)):
            async with asyncio.timeout(TIMEOUT):
                await fibonacci(client, 5, Record()).result(timeout=0.1)


async def test_a_goal_that_our_client_declines_is_over_for_whoever_gave_it():
    async def decline(goal, tell):
        raise Refused("It is too dark.")

    async with linked(2) as (robot, client), link(f"ws://127.0.0.1:{robot.port}") as far:
        other = await far.connected()
        client.provide_action("/look", "example_interfaces/Fibonacci", decline, goal=FibonacciGoal)
        await client.call("/beep", None, Told)
        goal = other.goal("/look", FibonacciGoal(order=1), result=Numbers, feedback=Numbers)
        with pytest.raises(Refused):
            await goal.result(timeout=TIMEOUT)
