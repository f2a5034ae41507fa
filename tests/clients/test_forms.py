"""How messages travel: typed arrays, ROS's own bytes, pictures and pieces, as roslib unpacks them."""

from __future__ import annotations

import pytest

from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import PoseWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import CompressedImage, Imu, JointState, LaserScan, NavSatFix
from bridge.msgs.std_msgs import Header, Time
from tests.bridge.wires import server
from tests.clients.peers import both, peer

SCAN = {"name": "/scan", "type": "sensor_msgs/LaserScan"}


def typed(kind: str, values: list[float]) -> dict[str, object]:
    """A typed array as the program tells of it."""
    return {"array": kind, "values": values}


SAMPLES = {
    "/odom": (
        Odometry(pose=PoseWithCovariance(covariance=[float(n) for n in range(36)])),
        lambda msg: msg["pose"]["covariance"],
        typed("Float64Array", list(range(36))),
    ),
    "/imu/data": (
        Imu(orientation_covariance=[-1.0] + [0.0] * 8),
        lambda msg: msg["orientation_covariance"],
        typed("Float64Array", [-1] + [0] * 8),
    ),
    "/fix": (
        NavSatFix(position_covariance=[4.0] + [0.0] * 8),
        lambda msg: msg["position_covariance"],
        typed("Float64Array", [4] + [0] * 8),
    ),
    "/joint_states": (
        JointState(name=["left", "right"], position=[0.5, 1.5]),
        lambda msg: (msg["name"], msg["position"]),
        (["left", "right"], typed("Float64Array", [0.5, 1.5])),
    ),
    "/scan": (
        LaserScan(ranges=Float32Array([1.0, 2.5])),
        lambda msg: msg["ranges"],
        typed("Float32Array", [1, 2.5]),
    ),
    "/camera/image/compressed": (
        CompressedImage(format="jpeg", data=b"\xff\xd8\xff"),
        lambda msg: msg["data"],
        typed("Uint8Array", [255, 216, 255]),
    ),
}
"""Of each topic a message, what of it is looked at, and what that must be."""


@pytest.mark.parametrize("topic", SAMPLES)
async def test_numbers_arrive_as_typed_arrays_in_cbor(topic):
    message, look, expected = SAMPLES[topic]
    async with server() as robot, peer("roslib", robot.port) as script:
        await script.do("subscribe", name=topic, type=message.MSGTYPE, compression="cbor")
        await script.settled()
        robot.publish(topic, message)
        assert look(await script.message(topic)) == expected


async def test_what_is_not_a_number_stays_so_in_cbor():
    async with server() as robot, peer("roslib", robot.port) as script:
        await script.do("subscribe", **SCAN, compression="cbor")
        await script.settled()
        robot.publish("/scan", LaserScan(ranges=Float32Array([float("inf"), float("nan"), 1.0])))
        # JSON, which the program tells it in, has neither infinity nor NaN
        assert (await script.message("/scan"))["ranges"] == typed("Float32Array", [None, None, 1])


async def test_cbor_raw_brings_the_bytes_of_ros():
    async with server() as robot, peer("roslib", robot.port) as script:
        await script.do("subscribe", name="/robot/info", type="std_msgs/String", compression="cbor-raw")
        await script.do("subscribe", name="/where", type="geometry_msgs/Vector3", compression="cbor-raw")
        await script.settled()
        await script.do(
            "publish", name="/where", type="geometry_msgs/Vector3", msg={"x": 1.0, "y": 0, "z": -2}
        )
        heard = await script.message("/where")
        one, zero, minus_two = [0] * 6 + [0xF0, 0x3F], [0] * 8, [0] * 7 + [0xC0]
        assert heard["bytes"] == typed("Uint8Array", one + zero + minus_two)
        assert {"secs", "nsecs"} <= set(heard)


@pytest.mark.parametrize("more", [{}, {"fragment_size": 200}], ids=["whole", "in pieces"])
async def test_png_is_unpacked(more):
    async with server() as robot, peer("roslib", robot.port) as script:
        await script.do("subscribe", **SCAN, compression="png")
        if more:
            await script.do(
                "say", op={"op": "subscribe", "id": "s", "topic": "/scan", "compression": "png", **more}
            )
        await script.settled()
        robot.publish("/scan", LaserScan(Header(Time(7, 0), "läser"), ranges=Float32Array(range(300))))
        heard = await script.message("/scan")
        assert (heard["header"]["frame_id"], heard["ranges"][-1]) == ("läser", 299)


@pytest.mark.parametrize("size", [1, 50, 400])
async def test_what_is_sent_in_pieces_is_put_together(size):
    async with server() as robot, peer("roslib", robot.port) as script:
        robot.publish("/robot/info", RobotInfo(name='Grüße aus "München", \\ \U0001f916'))
        await script.do("subscribe", name="/robot/info", type="pilothouse_msgs/RobotInfo")
        assert (await script.message("/robot/info"))["name"] == 'Grüße aus "München", \\ \U0001f916'
        again = {"op": "subscribe", "id": "s", "topic": "/robot/info", "fragment_size": size}
        await script.do("say", op=again)
        await script.settled()
        robot.publish("/robot/info", RobotInfo(name="Grüße \U0001f916"))
        heard = [event["msg"]["name"] for event in script.of("message")]
        while heard[-1] != "Grüße \U0001f916":
            heard.append((await script.message("/robot/info", len(heard) + 1))["name"])


async def test_pieces_from_a_client_are_put_together_in_any_order():
    async with server() as robot, both(robot.port) as (python, script):
        await script.do("subscribe", name="/chat", type="std_msgs/String")
        await python.do("advertise", name="/chat", type="std_msgs/String")
        await python.settled()
        pieces = ['{"op":"publish","to', 'pic":"/chat","msg":{"da', 'ta":"whole"}}']
        for number in (2, 0, 1):
            piece = {"op": "fragment", "id": "f", "data": pieces[number], "num": number, "total": 3}
            await python.do("say", op=piece)
        assert await script.message("/chat") == {"data": "whole"}


async def test_one_client_in_cbor_does_not_change_what_another_gets():
    """A binary frame would end roslibpy's connection."""
    async with server() as robot, both(robot.port) as (python, script):
        await script.do("subscribe", **SCAN, compression="cbor")
        await python.do("subscribe", **SCAN)
        for client in (python, script):
            await client.settled()
        robot.publish("/scan", LaserScan(ranges=Float32Array([1.0])))
        assert (await python.message("/scan"))["ranges"] == [1.0]
        assert (await script.message("/scan"))["ranges"] == typed("Float32Array", [1])
        assert python.of("close") == []
