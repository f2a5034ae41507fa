"""Less of a message for who asks for less, through the server."""

from __future__ import annotations

import asyncio
import threading

from bridge.core.errors import ProtocolError
from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.protocol import Reduction, Subscribed
from bridge.server.flow.message_reducing import MessageReducer
from bridge.server.flow.outgoing_messages import OutgoingMessage
from bridge.server.flow.priority_lanes import Lane, Stream
from tests.bridge.peers import peer
from tests.bridge.wires import Record, server

PICTURES = "/camera/image/compressed"


async def test_a_subscriber_gets_only_the_fields_it_asked_for():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/scan", reduce={"fields": ["range_max", "header.frame_id"]})
        await foreign.settled()
        robot.publish("/scan", LaserScan(range_max=8.0))
        assert (await foreign.hear())["msg"] == {"header": {"frame_id": ""}, "range_max": 8.0}


async def test_a_field_that_is_not_there_is_logged_and_costs_nobody_the_connection(caplog):
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic="/scan", reduce={"fields": ["colour"]})
        await foreign.settled()
        robot.publish("/scan", LaserScan())
        await foreign.settled()
    assert "has no field 'colour'" in caplog.text


async def test_who_asks_for_a_field_that_is_not_there_is_told_at_once():
    async with server() as robot, peer(robot) as foreign:
        await foreign.say(op="set_level", level="error")
        await foreign.say(op="subscribe", topic="/scan", id="7", reduce={"fields": ["colour"]})
        told = await foreign.hear()
        assert (told["op"], told["id"]) == ("status", "7")
        assert "sensor_msgs/LaserScan has no field 'colour', only header" in told["msg"]


async def test_what_can_never_be_sent_is_logged_once(caplog):
    topic = {"topic": "/theirs", "type": "geometry_msgs/Twist"}
    async with server() as robot, peer(robot) as foreign, peer(robot) as other:
        await foreign.say(op="subscribe", **topic, reduce={"fields": ["colour"]})
        await foreign.settled()
        await other.say(op="advertise", **topic)
        for _ in range(5):
            await other.say(op="publish", topic="/theirs", msg={"linear": {"x": 1.0}})
        await other.settled()
        await foreign.settled()
    assert caplog.text.count("has no field 'colour'") == 1


async def test_the_robot_makes_less_of_a_scan():
    def fewer(msg, wanted):
        return LaserScan(ranges=msg.ranges[: wanted.beams])

    async with server(reduce=fewer) as robot, peer(robot) as foreign, peer(robot) as whole:
        await foreign.say(op="subscribe", topic="/scan", reduce={"beams": 1})
        await foreign.settled()
        await whole.say(op="subscribe", topic="/scan")
        await whole.settled()
        robot.publish("/scan", LaserScan(ranges=Float32Array([1, 2])))
        assert (await foreign.hear())["msg"]["ranges"] == [1]
        assert (await whole.hear())["msg"]["ranges"] == [1, 2]


async def test_pictures_are_made_smaller_once_and_beside_the_loop():
    threads = []

    def smaller(msg, wanted):
        threads.append(threading.current_thread())
        return CompressedImage(data=msg.data[: wanted.width])

    async with server(reduce=smaller) as robot, peer(robot) as one, peer(robot) as other:
        for each in (one, other):
            await each.say(op="subscribe", topic=PICTURES, compression="cbor", reduce={"width": 2})
            await each.settled()
        robot.publish(PICTURES, CompressedImage(data=b"\xff\xd8\xff"))
        for each in (one, other):
            assert (await each.hear())["msg"]["data"] == b"\xff\xd8"
    assert len(threads) == 1
    assert threads[0] is not threading.main_thread()


async def test_of_pictures_that_come_faster_than_they_are_made_smaller_the_newest_is_next():
    let_go, made = threading.Semaphore(0), []

    def slowly(msg, wanted):
        made.append(bytes(msg.data))
        let_go.acquire(timeout=5)
        return msg

    async with server(reduce=slowly) as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic=PICTURES, compression="cbor", reduce={"width": 2})
        await foreign.settled()
        robot.publish(PICTURES, CompressedImage(data=b"0"))
        while not made:
            await foreign.settled()
        for data in (b"1", b"2", b"3"):
            robot.publish(PICTURES, CompressedImage(data=data))
        let_go.release(2)
        assert [(await foreign.hear())["msg"]["data"] for _ in range(2)] == [b"0", b"3"]


async def test_a_picture_that_cannot_be_made_smaller_is_logged_and_the_next_one_comes(caplog):
    def picky(msg, wanted):
        if not msg.data:
            raise ProtocolError("This is no picture.")
        return msg

    async with server(reduce=picky) as robot, peer(robot) as foreign:
        await foreign.say(op="subscribe", topic=PICTURES, compression="cbor", reduce={"width": 2})
        await foreign.settled()
        robot.publish(PICTURES, CompressedImage())
        while "This is no picture" not in caplog.text:
            await foreign.settled()
        robot.publish(PICTURES, CompressedImage(data=b"good"))
        assert (await foreign.hear())["msg"]["data"] == b"good"


class SendQueue:
    """Keeps what it is to send."""

    def __init__(self):
        self.offered = Record()

    def offer(self, stream, message):
        self.offered(stream)


async def test_who_unsubscribed_gets_no_picture_that_was_still_being_made():
    let_go = threading.Semaphore(0)

    def slowly(msg, wanted):
        let_go.acquire(timeout=5)
        return msg

    reducing, queue = MessageReducer(), SendQueue()
    message = OutgoingMessage(PICTURES, CompressedImage(data=b"0"), slowly)
    wanted = Subscribed(PICTURES, reduction=Reduction(width=2))
    left, stays = (Stream(PICTURES, Lane.BULK, wanted) for _ in range(2))
    for stream in (left, stays):
        reducing.offer(queue, stream, message)
    await asyncio.sleep(0)
    left.gone = True
    let_go.release()
    await queue.offered.reach(1)
    await reducing.close()
    assert queue.offered == [stays]
