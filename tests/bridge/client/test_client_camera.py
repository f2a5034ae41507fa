"""A camera's pictures, over a WebSocket of their own."""

from __future__ import annotations

import asyncio

import pytest

from bridge.client.client import CameraStream
from bridge.core import camera_frames as frames
from bridge.core.address import LinkLost
from tests.bridge.wires import Clock, Record, server, url


async def watched(robot, demands, seen, **options):
    stream = CameraStream(f"{url(robot)}/camera/front", seen, backoff=(0.01, 0.02), **options)
    running = asyncio.create_task(stream.run())
    await demands.reach(1)
    return stream, running


async def test_a_camera_shows_every_frame_that_it_keeps_up_with():
    demands, seen = Record(), Record()
    async with server(on_demand=demands) as robot:
        stream, running = await watched(robot, demands, seen, now=Clock(5.0))
        for seq in range(20):
            robot.publish_frame("front", frames.pack(seq, 1.5, b"jpeg", 640, 480))
            await seen.reach(seq + 1)
        assert seen[-1] == (frames.Frame(19, 1.5, 640, 480, b"jpeg"), 5.0)
        await stream.close()
        await running


async def test_a_camera_connects_again_and_passes_over_what_is_no_frame(caplog):
    demands, seen = Record(), Record()

    def broken_once(frame, received):
        seen(frame)
        if len(seen) == 1:
            raise ZeroDivisionError

    async with server(on_demand=demands) as robot:
        port = robot.port
        stream, running = await watched(robot, demands, broken_once)
        robot.publish_frame("front", frames.pack(1, 0.0, b"", 1, 1))
        await seen.reach(1)
    demands.clear()
    async with server(on_demand=demands, port=port) as robot:
        await demands.reach(1)
        robot.publish_frame("front", frames.pack(2, 0.0, b"", 1, 1))
        assert [frame.seq for frame in await seen.reach(2)] == [1, 2]
        await stream.close()
        await running
    assert "ZeroDivisionError" in caplog.text


async def test_a_camera_at_an_address_that_can_never_work_is_given_up_with_a_word(caplog):
    stream = CameraStream("front", print)
    await stream.run()
    assert "No pictures: The address must be like" in caplog.text


# the same picture again


async def test_a_camera_that_sees_the_same_shows_the_very_picture_with_the_new_stamp():
    demands, seen = Record(), Record()
    async with server(on_demand=demands) as robot:
        stream, running = await watched(robot, demands, seen, now=Clock(5.0))
        for seq, stamp in enumerate((1.0, 1.1, 1.2)):
            robot.publish_frame("front", frames.pack(seq, stamp, b"jpeg", 640, 480))
            await seen.reach(seq + 1)
        shown = [frame for frame, _ in seen]
        assert [frame.stamp for frame in shown] == [1.0, 1.1, 1.2]
        assert shown[2].jpeg is shown[1].jpeg is shown[0].jpeg  # the bytes came once
        await stream.close()
        await running


class Told:
    """A connection that has these messages for the client, and then ends."""

    def __init__(self, *messages):
        self.left, self.said = messages, []

    async def messages(self):
        for message in self.left:
            yield message

    def send(self, text):
        self.said.append(text)

    async def close(self):
        pass


async def shown_of(*messages):
    seen = Record()
    stream = CameraStream("ws://127.0.0.1:1/camera/front", lambda frame, _: seen(frame))
    for part in messages:
        with pytest.raises(LinkLost):
            await stream._watch(Told(*part))
    return [(frame.seq, frame.jpeg) for frame in seen]


def same(seq, stamp):
    return frames.pack_same(frames.Frame(seq, stamp, 8, 8, b""))


async def test_the_same_as_nothing_is_no_picture():
    assert await shown_of([same(1, 1.0)]) == []


async def test_the_same_as_before_the_connection_was_lost_is_no_picture():
    whole = frames.pack(1, 1.0, b"one", 8, 8)
    assert await shown_of([whole, same(2, 1.1)], [same(3, 1.2), frames.pack(4, 1.3, b"two", 8, 8)]) == [
        (1, b"one"),
        (2, b"one"),
        (4, b"two"),
    ]


async def test_the_same_as_a_picture_that_came_broken_is_not_taken_for_the_one_before_it():
    whole = frames.pack(1, 1.0, b"one", 8, 8)
    assert await shown_of([whole, b"PHX1" + whole[4:], same(3, 1.2)]) == [(1, b"one")]


async def test_a_frozen_camera_that_repeats_an_old_stamp_is_not_shown_as_fresh():
    whole = frames.pack(1, 1.0, b"one", 8, 8)
    assert await shown_of([whole, same(2, 1.0), same(3, 0.9)]) == [(1, b"one")]
