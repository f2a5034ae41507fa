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


# the same picture again


async def watched(cable, offer, clock, pictures, *, ack=True):
    """What became of these pictures, each acknowledged at once: (seq, jpeg) of whole ones, (seq, None) of headers alone."""
    for number, (seq, stamp, jpeg) in enumerate(pictures, 1):
        offer(seq, stamp, jpeg)
        await cable.sent.reach(number)
        clock.time += 0.01
        if ack:
            await cable.said.put(f"ack {seq}")
        await asyncio.sleep(0)
        clock.time += 0.05
    return [(int.from_bytes(raw[4:8], "big"), None if raw[:4] == b"PHS1" else raw[24:]) for raw in cable.sent]


class RawCable(Cable):
    """Keeps the very bytes."""

    async def send(self, message, *, text=None):
        self.sent(message)


@asynccontextmanager
async def one_who_watches(clock, *, knows_same):
    cable, levels = RawCable(), QualityLevels(shrink)
    watcher = CameraSocket(cable, clock, coarsest=levels.coarsest, knows_same=knows_same)
    running = asyncio.create_task(watcher.run())

    def offer(seq, stamp, jpeg):
        watcher.offer(levels.picture(frames.pack(seq, stamp, jpeg, 8, 8)))

    try:
        yield cable, offer, watcher.quality
    finally:
        await cable.said.put(None)
        await running
        await levels.close()


async def test_a_watcher_that_knows_them_gets_a_header_alone_for_a_picture_that_came_out_the_same():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=True) as (cable, offer, _):
        taken = [(1, 1.0, b"one"), (2, 1.1, b"one"), (3, 1.2, b"one"), (4, 1.3, b"two"), (5, 1.4, b"one")]
        seen = await watched(cable, offer, clock, taken)
        assert seen == [(1, b"one"), (2, None), (3, None), (4, b"two"), (5, b"one")]
        assert len(cable.sent[1]) == 24
        before = frames.unpack(cable.sent[0])
        assert frames.unpack(cable.sent[1], before) == frames.Frame(2, 1.1, 8, 8, b"one")


async def test_any_other_watcher_gets_every_picture_whole():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=False) as (cable, offer, _):
        seen = await watched(cable, offer, clock, [(1, 1.0, b"one"), (2, 1.1, b"one")])
        assert seen == [(1, b"one"), (2, b"one")]


async def test_a_camera_that_gives_its_old_picture_with_its_old_stamp_has_taken_no_other():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=True) as (cable, offer, _):
        seen = await watched(cable, offer, clock, [(1, 1.0, b"one"), (2, 1.0, b"one"), (3, 0.5, b"one")])
        assert seen == [(1, b"one"), (2, b"one"), (3, b"one")]


async def test_one_who_joins_later_gets_a_whole_picture_first():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=True) as (cable, offer, _):
        await watched(cable, offer, clock, [(1, 1.0, b"one"), (2, 1.1, b"one")])
        async with one_who_watches(clock, knows_same=True) as (later, offer_later, _):
            assert await watched(later, offer_later, clock, [(3, 1.2, b"one")]) == [(3, b"one")]


async def test_no_more_headers_than_pictures_go_to_one_who_never_answers():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=True) as (cable, offer, _):
        await watched(cable, offer, clock, [(1, 1.0, b"one"), (2, 1.1, b"one")], ack=False)
        for seq in range(3, 30):
            offer(seq, float(seq), b"one")
            await asyncio.sleep(0)
        assert len(cable.sent) == 2


async def test_a_picture_that_stays_the_same_is_sent_once_more_when_the_link_carries_a_finer_one():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=True) as (cable, offer, quality):
        quality.level = COARSEST
        seen = await watched(cable, offer, clock, [(n, float(n), b"x" * 64) for n in range(1, 200)])
        whole = [len(jpeg) for _, jpeg in seen if jpeg is not None]
        assert whole == [64 >> level for level in range(COARSEST, -1, -1)]
        assert quality.level == 0


async def test_who_has_a_fine_picture_gets_no_coarser_one_of_the_same():
    clock = Clock(100.0)
    async with one_who_watches(clock, knows_same=True) as (cable, offer, quality):
        await watched(cable, offer, clock, [(1, 1.0, b"x" * 64)])
        quality.level = COARSEST
        offer(2, 2.0, b"x" * 64)
        await cable.sent.reach(2)
        assert cable.sent[1][:4] == b"PHS1"
