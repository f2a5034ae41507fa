"""A watcher's connection, against a socket and a clock that only the test moves; and once over a slow wire."""

from __future__ import annotations

import asyncio
import contextlib
from contextlib import asynccontextmanager

from bridge.core import camera_frames as frames
from bridge.server.camera_socket import CameraSocket
from bridge.server.flow.picture_quality import COARSEST
from bridge.server.flow.quality_levels import QualityLevels
from tests.bridge.peers import peer
from tests.bridge.wires import Clock, Record, Wire, server, wire


class Cable:
    """What the server sends is recorded; what the watcher says is put in."""

    def __init__(self):
        self.sent = Record()
        self.said = asyncio.Queue()

    async def send(self, message, *, text=None):
        self.sent(frames.unpack(message))

    async def __aiter__(self):
        while (text := await self.said.get()) is not None:
            yield text


async def shrink(jpeg, level):
    return jpeg[: len(jpeg) >> level]


@asynccontextmanager
async def watching(clock):
    cable, levels = Cable(), QualityLevels(shrink)
    watcher = CameraSocket(cable, clock, coarsest=levels.coarsest)
    running = asyncio.create_task(watcher.run())
    try:
        yield cable, lambda seq: watcher.offer(levels.picture(frames.pack(seq, 0.0, b"x" * 64, 8, 8)))
    finally:
        await cable.said.put(None)
        await running
        await levels.close()


async def test_a_watcher_whose_acknowledgements_are_slow_gets_smaller_pictures():
    clock = Clock(100.0)
    async with watching(clock) as (cable, offer):
        for seq in range(1, 5):
            offer(seq)
            await cable.sent.reach(seq)
            clock.time += 0.4
            await cable.said.put(f"ack {seq}")
            await asyncio.sleep(0)
            clock.time += 0.5
        assert [len(frame.jpeg) for frame in cable.sent] == [64 >> level for level in range(COARSEST + 1)]


async def test_a_watcher_who_is_quick_gets_every_picture_whole():
    clock = Clock(100.0)
    async with watching(clock) as (cable, offer):
        for seq in range(1, 40):
            offer(seq)
            await cable.sent.reach(seq)
            clock.time += 0.01
            await cable.said.put(f"ack {seq}")
            await asyncio.sleep(0)
            clock.time += 0.05
        assert {len(frame.jpeg) for frame in cable.sent} == {64}


async def test_what_is_no_acknowledgement_changes_nothing():
    async with watching(Clock()) as (cable, offer):
        for seq in (1, 2):
            offer(seq)
            await cable.sent.reach(seq)
        offer(3)
        for text in ("ack", "ack -1", "ack 99999999999", "nack 1", b"ack 1", "ack ²"):
            await cable.said.put(text)
        await asyncio.sleep(0)
        assert len(cable.sent) == 2
        await cable.said.put("ack 1")
        await cable.sent.reach(3)


async def test_a_real_wire_that_is_too_slow_gets_smaller_pictures_and_none_pile_up(monkeypatch):
    async def slowly(self, source, sink):
        with contextlib.suppress(OSError):
            while data := await source.read(2048):
                await asyncio.sleep(len(data) * 8 / 1e6)
                sink.write(data)
                await sink.drain()
        sink.close()

    monkeypatch.setattr(Wire, "_pump", slowly)
    shown = 0

    async def show(robot):
        nonlocal shown
        while True:
            shown += 1
            robot.publish_frame("front", frames.pack(shown, 0.0, bytes(32_000), 8, 8))
            await asyncio.sleep(1 / 15)

    async with (
        server(cameras=["front"], shrink=shrink) as robot,
        wire(robot.port) as cable,
        peer(cable, "/camera/front") as watcher,
    ):
        showing = asyncio.create_task(show(robot))
        small = 0
        async with asyncio.timeout(20):
            while small < 10:
                frame = frames.unpack(await watcher.ws.recv())
                await watcher.ws.send(f"ack {frame.seq}")
                small = small + 1 if len(frame.jpeg) < 16_001 else 0
        assert shown - frame.seq < 8
        showing.cancel()
        await asyncio.gather(showing, return_exceptions=True)
