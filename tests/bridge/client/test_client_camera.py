"""A camera's pictures, over a WebSocket of their own."""

from __future__ import annotations

import asyncio

from bridge.client.client import CameraStream
from bridge.core import camera_frames as frames
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
