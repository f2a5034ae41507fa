"""The server as a foreign client meets it: real sockets, plain JSON."""

from __future__ import annotations

import asyncio
import base64

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from bridge.core import camera_frames as frames
from bridge.core.errors import BridgeError, Refused
from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import CommandResponse, ControlStatus, Event, RobotInfo
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.msgs.std_msgs import Header, Time
from bridge.server.server import BridgeServer
from robotside.door.door import Door
from tests.bridge.peers import bare, peer
from tests.bridge.wires import Clock, Record, server, service, url


async def test_a_subscriber_gets_what_is_published_from_then_on():
    async with server() as robot, peer(robot) as foreign:
        robot.publish("/odom", Odometry(child_frame_id="before"))
        await foreign.say(op="subscribe", topic="/odom", type="nav_msgs/msg/Odometry")
        await foreign.settled()
        robot.publish("/odom", Odometry(child_frame_id="after"))
        heard = await foreign.hear()
        assert set(heard) == {"op", "topic", "msg"}
        assert heard["msg"]["child_frame_id"] == "after"


async def test_the_topic_comes_back_as_the_client_wrote_it():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="odom")
        await foreign.settled()
        robot.publish("/odom", Odometry())
        assert (await foreign.hear())["topic"] == "odom"


async def test_a_latched_topic_is_delivered_on_subscribing():
    async with server() as robot, peer(robot) as foreign:
        robot.publish("/robot/info", RobotInfo(name="Patrol-1"))
        await foreign.say(op="subscribe", topic="/robot/info")
        assert (await foreign.hear())["msg"]["name"] == "Patrol-1"


async def test_who_unsubscribed_gets_nothing_more():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/events", id="a")
        await foreign.say(op="unsubscribe", topic="/events", id="a")
        await foreign.settled()
        robot.publish("/events", Event(text="nobody listens"))
        await foreign.settled()


async def test_cbor_comes_as_binary_frames_with_typed_arrays():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/scan", compression="cbor")
        await foreign.settled()
        robot.publish("/scan", LaserScan(ranges=Float32Array([1.0])))
        heard = await foreign.hear()
        assert (heard["topic"], heard["msg"]["ranges"].tag) == ("/scan", 85)


async def test_bytes_come_as_base64_in_json():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/camera/image/compressed")
        await foreign.settled()
        robot.publish("/camera/image/compressed", CompressedImage(data=b"\xff\xd8"))
        assert base64.b64decode((await foreign.hear())["msg"]["data"]) == b"\xff\xd8"


async def test_a_throttled_subscriber_gets_the_newest_when_its_time_has_come():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/odom", throttle_rate=50)
        await foreign.settled()
        clock = asyncio.get_running_loop().time
        robot.publish("/odom", Odometry(child_frame_id="first"))
        began = clock()
        assert (await foreign.hear())["msg"]["child_frame_id"] == "first"
        for name in ("second", "third"):
            robot.publish("/odom", Odometry(child_frame_id=name))
        assert (await foreign.hear())["msg"]["child_frame_id"] == "third"
        assert clock() - began >= 0.045


@pytest.mark.parametrize(
    ("op", "said"),
    [
        (
            {"op": "publish", "topic": "/cmd_vel", "msg": {"linaer": {"x": 1}}},
            "publish: /cmd_vel (geometry_msgs/Twist) has no field linaer; it is passed over.",
        ),
        (
            {"op": "call_service", "service": "/stop", "args": {"client_nmae": "A"}, "id": "7"},
            "call_service: /stop (pilothouse_msgs/CommandRequest) has no field client_nmae; it is passed over.",
        ),
    ],
)
async def test_a_misspelt_field_is_remarked_to_who_wants_warnings(op, said):
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="set_level", level="warning")
        await foreign.say(**op)
        remarks = []
        while not remarks:
            heard = await foreign.hear()
            remarks += [heard] if heard["op"] == "status" else []
        assert (remarks[0]["level"], remarks[0]["msg"], remarks[0].get("id")) == (
            "warning",
            said,
            op.get("id"),
        )


async def test_nothing_is_remarked_of_what_is_spelled_right_or_to_who_wants_errors_only():
    async with server() as robot, peer(robot) as foreign:
        for level, msg in (("warning", {"linear": {"x": 0}}), ("error", {"linaer": {}})):
            await foreign.say(op="set_level", level=level)
            await foreign.say(op="publish", topic="/cmd_vel", msg=msg)
            await foreign.settled()


async def test_a_client_s_message_without_a_stamp_gets_that_of_now_and_an_order_does_not():
    heard = Record()
    async with server(on_message=heard, now=lambda: 12.5) as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/goal", type="geometry_msgs/PointStamped")
        await foreign.say(op="advertise", topic="/goal", type="geometry_msgs/PointStamped")
        await foreign.say(op="publish", topic="/goal", msg={"header": {"frame_id": "map"}})
        header = (await foreign.hear())["msg"]["header"]
        assert header == {"stamp": {"secs": 12, "nsecs": 500_000_000}, "frame_id": "map", "seq": 0}
        await foreign.say(op="publish", topic="/cmd_manoeuvre", msg={"kind": "tilt"})
        (order,) = await heard.reach(1)
        assert order[2].header.stamp == Time()


async def test_a_published_command_arrives_typed_with_its_session_and_stamp():
    heard = Record()
    async with server(on_message=heard) as robot, peer(robot) as foreign:
        await foreign.say(op="advertise", topic="/cmd_vel", type="geometry_msgs/Twist")
        await foreign.say(op="publish", topic="cmd_vel", msg={"linear": {"x": 0.5}}, stamp=12.5)
        await foreign.say(op="publish", topic="/cmd_vel", msg={})
        first, second = await heard.reach(2)
        (session,) = robot.operators
        assert first == (session, "/cmd_vel", Twist(Vector3(0.5)), 12.5)
        assert second == (session, "/cmd_vel", Twist(), None)


@pytest.mark.parametrize(
    "op",
    [
        {"op": "publish", "topic": "/odom", "msg": {}},
        {"op": "publish", "topic": "/nowhere", "msg": {}},
        {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": 5}},
        {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": "fast"}}},
        {"op": "subscribe", "topic": "/nowhere"},
        {"op": "subscribe", "topic": "/odom", "type": "sensor_msgs/Imu"},
        {"op": "advertise", "topic": "/cmd_vel", "type": "std_msgs/String"},
        {"op": "advertise_service", "service": "/stop", "type": "std_srvs/Trigger"},
        {"op": "advertise_action", "action": "/task", "type": "x/Y", "id": []},
        {"op": "advertise", "topic": "/odom", "type": "nav_msgs/Odometry"},
        {"op": "cancel_action_goal", "action": "/task", "id": "g"},
        {"op": "status", "level": "error", "msg": ""},
        {"op": "dance"},
        {"topic": "/odom"},
    ],
)
async def test_what_makes_no_sense_is_passed_over_in_silence_unless_asked(op):
    heard = Record()
    async with server(on_message=heard) as robot, peer(robot) as foreign:
        await foreign.say(**op)
        await foreign.settled()
        await foreign.say(op="set_level", level="error")
        await foreign.say(**op)
        remark = await foreign.hear()
        assert (remark["op"], remark["level"], remark["msg"][-1]) == ("status", "error", ".")
        assert heard == []


@pytest.mark.parametrize("text", ["hello", "[]", "\x00", '{"op":', b"\xff\xfe", "9" * 5000])
async def test_garbage_costs_nobody_the_connection(text):
    async with server() as robot, peer(robot) as foreign:
        await foreign.ws.send(text)
        await foreign.settled()


async def test_a_service_is_answered_under_its_id_whatever_its_kind():
    async with server() as robot, peer(robot) as foreign:
        for given in ("call:1", 7, 1.5):
            answer = await foreign.call("/stop", id=given, args={"command_id": "c1"})
            added = {"code": "", "actor_id": "", "parameters": []}
            assert answer == {
                "op": "service_response",
                "service": "/stop",
                "values": {"success": True, "message": "Accepted c1."} | added,
                "result": True,
                "id": given,
            }
        assert "id" not in await foreign.call("stop")


async def test_an_empty_request_as_of_a_trigger_works():
    async with server() as robot, peer(robot) as foreign:
        for args in ({"args": {}}, {"args": []}, {"args": None}, {}):
            assert (await foreign.call("/stop", **args))["values"]["success"] is True


def refuse(session, request):
    raise Refused("The battery is too low.")


def fail(session, request):
    raise ZeroDivisionError


async def later(session, request):
    await asyncio.get_running_loop().run_in_executor(None, lambda: None)
    return CommandResponse(success=True, message="later")


async def refuse_later(session, request):
    raise Refused("Not now.")


async def test_a_refusal_is_false_with_its_sentence(caplog):
    services = [service("/no", refuse), service("/not_now", refuse_later), service("/fault", fail)]
    async with server(services=services) as robot, peer(robot) as foreign:
        answers = {name: await foreign.call(name) for name in ("/no", "/not_now", "/fault", "/none")}
    assert {answer["result"] for answer in answers.values()} == {False}
    assert {name: answer["values"] for name, answer in answers.items()} == {
        "/no": "The battery is too low.",
        "/not_now": "Not now.",
        "/fault": "The robot failed at /fault; its log says why.",
        "/none": 'This robot has no service "/none".',
    }
    assert "ZeroDivisionError" in caplog.text


async def test_a_request_that_does_not_fit_is_refused_with_the_field():
    async with server() as robot, peer(robot) as foreign:
        answer = await foreign.call("/stop", args={"valid_for": "long"})
        assert answer["values"] == 'valid_for must be a number or null, not "long".'


async def test_a_slow_service_does_not_hold_up_the_others():
    release = asyncio.Event()

    async def slow(session, request):
        await release.wait()
        return CommandResponse(success=True, message="slow")

    async with server(services=[service("/slow", slow), service()]) as robot, peer(robot) as foreign:
        await foreign.say(op="call_service", service="/slow", id="slow")
        assert (await foreign.call("/stop", id="stop"))["id"] == "stop"
        release.set()
        assert (await foreign.hear())["id"] == "slow"


async def test_a_service_still_at_work_when_its_caller_leaves_is_given_up():
    begun, ended = Record(), Record()

    async def endless(session, request):
        begun(session)
        try:
            await asyncio.Event().wait()
        finally:
            ended(session)

    async with server(services=[service("/endless", endless)]) as robot:
        async with peer(robot) as foreign:
            await foreign.say(op="call_service", service="/endless")
            await begun.reach(1)
        await ended.reach(1)


async def test_the_time_is_that_of_the_robots_clock():
    async with server(now=Clock(77.5)) as robot, peer(robot) as foreign:
        answer = await foreign.call("rosapi/get_time")
        assert answer["values"] == {"time": {"secs": 77, "nsecs": 500_000_000}}


async def test_a_session_knows_its_address_and_when_it_was_last_heard_and_is_gone_afterwards():
    clock, gone = Clock(10.0), Record()
    async with server(now=clock, on_gone=gone) as robot:
        async with peer(robot) as foreign:
            await foreign.settled()
            (session,) = robot.operators
            assert session.address.startswith("127.0.0.1:")
            clock.time = 12.0
            await foreign.settled()
            assert (session.opened, session.last_heard) == (10.0, 12.0)
        assert await gone.reach(1) == [session]
        assert robot.operators == set()


async def test_demand_follows_subscribers_even_those_who_vanish():
    demands = Record()
    async with server(on_demand=demands) as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/camera/image/compressed", id="a")
        await foreign.say(op="subscribe", topic="/camera/image/compressed", id="b")
        await demands.reach(1)
        foreign.ws.transport.abort()
        await demands.reach(2)
    topic = "/camera/image/compressed"
    assert demands == [(topic, True), (topic, False)]


async def test_a_fault_in_the_robots_ears_costs_nobody_the_connection(caplog):
    def broken(*_):
        raise ZeroDivisionError

    async with server(on_message=broken) as robot, peer(robot) as foreign:
        await foreign.say(op="publish", topic="/cmd_vel", msg={})
        await foreign.settled()
    assert "ZeroDivisionError" in caplog.text


def big_scan(number):
    return LaserScan(header=Header(frame_id=str(number)), ranges=Float32Array([1.1] * 20_000))


async def test_a_client_that_does_not_read_costs_the_others_nothing_and_gets_the_newest_later():
    async with server() as robot, peer(robot, max_queue=1) as stuck, peer(robot) as quick:
        for each in (stuck, quick):
            await each.say(op="subscribe", topic="/scan")
            await each.settled()
        stuck.ws.transport.pause_reading()
        for number in range(60):
            robot.publish("/scan", big_scan(number))
            assert (await quick.hear())["msg"]["header"]["frame_id"] == str(number)
        stuck.ws.transport.resume_reading()
        names = []
        while "59" not in names:
            names.append((await stuck.hear())["msg"]["header"]["frame_id"])
        assert len(names) < 40


async def test_a_client_that_never_reads_its_events_is_disconnected_and_the_others_are_not():
    gone = Record()
    async with server(on_gone=gone) as robot, peer(robot, max_queue=1) as stuck, peer(robot) as quick:
        for each in (stuck, quick):
            await each.say(op="subscribe", topic="/events")
            await each.settled()
        stuck.ws.transport.pause_reading()
        for number in range(1000):
            robot.publish("/events", Event(id=number, text="x" * 50_000))
            assert (await quick.hear())["msg"]["id"] == number
            if gone:
                break
        assert len(await gone.reach(1)) == 1
        assert len(robot.operators) == 1


async def test_everything_that_is_not_a_stream_arrives_in_order():
    async with server() as robot, peer(robot) as foreign:
        for topic in ("/events", "/control/status"):
            await foreign.say(op="subscribe", topic=topic)
        await foreign.settled()
        for number in range(100):
            robot.publish("/events", Event(id=number))
            robot.publish("/control/status", ControlStatus(driver=str(number)))
        heard = [await foreign.hear() for _ in range(200)]
        assert [h["msg"]["id"] for h in heard if h["topic"] == "/events"] == list(range(100))
        drivers = [h["msg"]["driver"] for h in heard if h["topic"] == "/control/status"]
        assert drivers == [str(number) for number in range(100)]


def picture(seq):
    return frames.pack(seq, 1.0, b"jpeg", 640, 480)


async def test_a_camera_sends_two_frames_ahead_and_then_the_newest_when_acknowledged():
    demands = Record()
    async with server(on_demand=demands) as robot, peer(robot, "/camera/front") as viewer:
        await demands.reach(1)
        robot.publish_frame("back", picture(99))
        seen = []
        for seq in (1, 2):
            robot.publish_frame("front", picture(seq))
            seen.append(frames.unpack(await viewer.ws.recv()).seq)
        for seq in (3, 4, 5):
            robot.publish_frame("front", picture(seq))
            await (await viewer.ws.ping())
        for text in ("ack 77", "ack x", "hello", "ack 1"):
            await viewer.ws.send(text)
        seen.append(frames.unpack(await viewer.ws.recv()).seq)
        assert seen == [1, 2, 5]
        assert robot.operators == set()


async def test_a_camera_that_does_not_exist_is_refused_with_those_that_do():
    async with server(cameras=["front", "rear"]) as robot:
        with pytest.raises(InvalidStatus) as caught:
            await connect(f"{url(robot)}/camera/left", proxy=None)
        assert caught.value.response.status_code == 404
        assert b"there is: front, rear" in caught.value.response.body


async def test_a_port_that_is_taken_is_one_sentence():
    async with server() as first:
        second = BridgeServer(Door())
        with pytest.raises(BridgeError, match=f"Port {first.port} on 127.0.0.1 is taken by another program"):
            await second.start(port=first.port)


async def test_closing_tells_the_clients_and_ends_quickly_even_if_one_does_not_read():
    clock = asyncio.get_running_loop().time
    async with server() as robot, peer(robot) as awake, peer(robot, max_queue=1) as stuck:
        await stuck.say(op="subscribe", topic="/scan")
        await stuck.settled()
        stuck.ws.transport.pause_reading()
        for number in range(100):
            robot.publish("/scan", big_scan(number))
            await asyncio.sleep(0)
        began = clock()
        await robot.close()
        assert clock() - began < 1.5
        with pytest.raises(ConnectionClosed):
            await awake.ws.recv()
        stuck.ws.transport.abort()


async def test_what_was_never_started_closes_too():
    await BridgeServer(Door()).close()


async def test_plain_http_on_the_port_is_answered_and_not_logged_as_a_fault(caplog):
    async with server() as robot, bare(robot) as (reader, writer):
        writer.write(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
        assert b"426" in await reader.readline()
    assert caplog.text == ""
