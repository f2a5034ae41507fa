"""One picture in several levels, each made once however many want it."""

from __future__ import annotations

import asyncio

import pytest

from bridge.core import camera_frames as frames
from bridge.core.errors import BridgeError, ProtocolError
from bridge.server.flow.quality_levels import QualityLevels

FRAME = frames.pack(7, 1.5, b"a large picture", 640, 480)


class Bench:
    """Makes a level when the test says so."""

    def __init__(self):
        self.asked = []
        self.done = asyncio.Event()

    async def __call__(self, jpeg, level):
        self.asked.append((jpeg, level))
        await self.done.wait()
        return b"small"


async def test_a_level_is_made_once_and_keeps_stamp_number_and_size_of_the_original():
    bench = Bench()
    bench.done.set()
    picture = QualityLevels(bench).picture(FRAME)
    both = await asyncio.gather(picture.at(2), picture.at(2))
    assert [frames.unpack(raw) for raw in both] == [frames.Frame(7, 1.5, 640, 480, b"small")] * 2
    assert await picture.at(2) is await picture.at(2)
    assert bench.asked == [(b"a large picture", 2)]


async def test_the_original_is_given_as_it_is():
    bench = Bench()
    assert await QualityLevels(bench).picture(FRAME).at(0) is FRAME
    assert await QualityLevels(None).picture(FRAME).at(3) is FRAME
    assert bench.asked == []


async def test_a_level_that_cannot_be_made_is_the_original():
    async def fail(jpeg, level):
        raise BridgeError("no JPEG")

    assert await QualityLevels(fail).picture(FRAME).at(1) is FRAME


async def test_who_leaves_does_not_take_the_picture_from_the_others():
    bench = Bench()
    picture = QualityLevels(bench).picture(FRAME)
    first, second = asyncio.create_task(picture.at(1)), asyncio.create_task(picture.at(1))
    await asyncio.sleep(0)
    first.cancel()
    bench.done.set()
    assert frames.unpack(await second).jpeg == b"small"
    assert len(bench.asked) == 1


async def test_what_is_still_being_made_ends_with_its_owner():
    levels = QualityLevels(Bench())
    waiting = asyncio.create_task(levels.picture(FRAME).at(1))
    await asyncio.sleep(0)
    await levels.close()
    with pytest.raises(asyncio.CancelledError):
        await waiting


async def test_what_is_no_frame_has_no_levels():
    with pytest.raises(ProtocolError, match="must begin with b'PHF1'"):
        QualityLevels(None).picture(b"JPEG")
