"""STOP and fresh samples on links that carry less than is sent: real sockets, a wire that freezes."""

from __future__ import annotations

import asyncio

from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header
from bridge.window import START
from tests.bridge.peers import peer
from tests.bridge.wires import server, wire

PICTURES = "/camera/image/compressed"


async def test_stop_is_answered_before_the_samples_that_had_to_wait():
    async with server() as robot, wire(robot.port) as cable, peer(cable) as far:
        for topic in ("/odom", "/imu/data"):
            await far.say(op="subscribe", topic=topic, queue_length=100)
            await far.settled()
        cable.freeze()
        for number in range(3000):
            robot.publish("/odom", Odometry(header=Header(frame_id=str(number))))
            await asyncio.sleep(0)
        await far.say(op="call_service", service="/stop", id="stop")
        cable.thaw()
        before = 0
        while (heard := await far.hear()).get("id") != "stop":
            before += 1
            assert heard["op"] == "publish"
        assert before < 2 * START // 700


async def test_who_stood_still_continues_with_the_newest():
    async with server() as robot, wire(robot.port) as cable, peer(cable) as far:
        await far.say(op="subscribe", topic="/odom")
        await far.settled()
        cable.freeze()
        for number in range(3000):
            robot.publish("/odom", Odometry(header=Header(frame_id=str(number))))
            await asyncio.sleep(0)
        cable.thaw()
        numbers = [-1]
        while numbers[-1] != 2999:
            numbers.append(int((await far.hear())["msg"]["header"]["frame_id"]))
        assert len(numbers) < 2 * START // 700


async def test_pictures_for_who_stands_still_are_not_piled_up():
    async with server() as robot, peer(robot, max_queue=1) as stuck, peer(robot) as quick:
        for each in (stuck, quick):
            await each.say(op="subscribe", topic=PICTURES, compression="cbor", queue_length=50)
            await each.settled()
        stuck.ws.transport.pause_reading()
        for number in range(100):
            robot.publish(PICTURES, CompressedImage(format=str(number), data=bytes(45_000)))
            assert (await quick.hear())["msg"]["format"] == str(number)
        stuck.ws.transport.resume_reading()
        numbers = ["-1"]
        while numbers[-1] != "99":
            numbers.append((await stuck.hear())["msg"]["format"])
        assert len(numbers) < 12
