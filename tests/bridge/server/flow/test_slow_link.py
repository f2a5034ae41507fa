"""STOP and fresh samples on links that carry less than is sent: real sockets, a wire that freezes."""

from __future__ import annotations

import asyncio
import json
import tracemalloc

import pytest

from bridge.msgs.arrays import Float32Array
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.msgs.std_msgs import Header
from bridge.server.flow.send_window import START_WINDOW
from tests.bridge.peers import peer
from tests.bridge.server.test_rosbridge_session import House, said
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
        assert before < 2 * START_WINDOW // 700


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
        assert len(numbers) < 2 * START_WINDOW // 700


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


STALLS = {
    "the connection takes no more": lambda writer: setattr(writer, "paused", True),
    "nobody answers": lambda writer: None,
}


@pytest.mark.parametrize("stall", STALLS)
async def test_a_client_that_stands_still_costs_no_more_memory_however_long(stall):
    house = House()
    client, writer = house.join()
    for topic in ("/odom", "/scan", "/imu/data", "/map", PICTURES):
        client.on_message(said({"op": "subscribe", "topic": topic, "queue_length": 100}))
    STALLS[stall](writer)

    def publish(count):
        for number in range(count):
            house.clock.time += 0.01
            house.switchboard.publish("/odom", Odometry(header=Header(frame_id=str(number))))
            house.switchboard.publish("/scan", LaserScan(ranges=Float32Array([float(number)] * 360)))
            house.switchboard.publish(PICTURES, CompressedImage(data=bytes(10_000)))
            house.step()

    publish(300)
    written = len(writer.writes)
    tracemalloc.start()
    try:
        publish(100)
        begun = tracemalloc.get_traced_memory()[0]
        publish(900)
        grown = tracemalloc.get_traced_memory()[0] - begun
    finally:
        tracemalloc.stop()
    assert grown < 20_000
    assert len(writer.writes) == written
    await client.close()


@pytest.mark.parametrize("stall", STALLS)
async def test_who_catches_up_gets_no_sample_that_is_older_than_two_periods(stall):
    house = House()
    client, writer = house.join()
    client.queue._clock = house.clock
    client.on_message(said({"op": "subscribe", "topic": "/odom"}))
    client.queue.flush()

    def pass_on(seconds):
        for _ in range(round(20 * seconds)):
            house.clock.time += 0.05
            house.switchboard.publish("/odom", Odometry(header=Header(frame_id=str(house.clock.time))))
            house.step()

    STALLS[stall](writer)
    pass_on(60.0)
    writer.writes.clear()
    writer.paused = False
    client.on_drained()
    for content in writer.unanswered:
        client.on_pong(content)
    house.step()
    found = [house.clock.time - float(json.loads(text)["msg"]["header"]["frame_id"]) for text in writer.heard]
    assert found
    assert max(found) <= 0.1
    await client.close()
