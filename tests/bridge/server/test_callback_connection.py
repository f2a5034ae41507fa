"""WebSockets that are heard at once: whatever the protocol allows, and what it does not."""

from __future__ import annotations

import asyncio
import contextlib
import itertools
import json
import struct
from contextlib import asynccontextmanager

import pytest
from websockets.exceptions import ConnectionClosedError
from websockets.frames import Frame, Opcode

from bridge.server import callback_connection as server_connection
from bridge.server import rosbridge_session as serving
from bridge.server.flow.send_queue import FULL_TURNS
from bridge.server.reception.places import FULL, Limits
from tests.bridge.peers import bare, peer
from tests.bridge.wires import TIMEOUT, Record, server

TWIST = {"op": "publish", "topic": "/cmd_vel", "msg": {"linear": {"x": 0.5}}}


def speed(x):
    return json.dumps(TWIST | {"msg": {"linear": {"x": x}}})


async def test_a_message_in_several_frames_is_one_and_in_its_place():
    heard = Record()
    async with server(on_message=heard) as robot, peer(robot) as foreign:
        await foreign.settled()
        for x in (1.0, 2.0):
            text = speed(x)
            await foreign.ws.send([text[:10], text[10:20], text[20:]])
            await foreign.ws.send(speed(x + 0.5))
        await heard.reach(4)
        assert [msg.linear.x for _, _, msg, _ in heard] == [1.0, 1.5, 2.0, 2.5]


HANDSHAKE = (
    b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    b"Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n"
)


@pytest.mark.parametrize("busy", [False, True])
async def test_what_comes_with_the_handshake_is_heard_in_order(busy, monkeypatch):
    if busy:
        slowly(monkeypatch)
    heard = Record()
    async with server(on_message=heard) as robot, bare(robot) as (_, writer):
        first = speed(0.0).encode()
        early = [
            Frame(Opcode.TEXT, first[:9], fin=False).serialize(mask=True),
            Frame(Opcode.CONT, first[9:]).serialize(mask=True),
        ]
        early += [Frame(Opcode.TEXT, speed(x).encode()).serialize(mask=True) for x in (1.0, 2.0)]
        begun = speed(3.0).encode()
        early.append(Frame(Opcode.TEXT, begun[:5], fin=False).serialize(mask=True))
        writer.write(HANDSHAKE + b"".join(early))
        await heard.reach(3)
        writer.write(Frame(Opcode.CONT, begun[5:]).serialize(mask=True))
        writer.write(Frame(Opcode.TEXT, speed(4.0).encode()).serialize(mask=True))
        await heard.reach(5)
        assert [msg.linear.x for _, _, msg, _ in heard] == [0.0, 1.0, 2.0, 3.0, 4.0]


@pytest.mark.parametrize(
    ("frames", "code"),
    [
        ([Frame(Opcode.TEXT, b'{"op":"\xff"}')], 1007),
        ([Frame(Opcode.TEXT, b"\xe2\x82", fin=False), Frame(Opcode.CONT, b"(")], 1007),
        ([Frame(Opcode.CONT, b"x")], 1002),
        ([Frame(Opcode.TEXT, b"x", fin=False), Frame(Opcode.TEXT, b"y")], 1002),
        ([Frame(Opcode.TEXT, b"", fin=False)] + [Frame(Opcode.CONT, b"", fin=False)] * 1001, 1008),
    ],
)
async def test_what_breaks_the_protocol_ends_that_connection_cleanly_and_no_other(frames, code):
    gone = Record()
    async with server(on_gone=gone) as robot, peer(robot) as bad, peer(robot) as good:
        await bad.settled()
        for frame in frames:
            bad.ws.transport.write(frame.serialize(mask=True))
        with pytest.raises(ConnectionClosedError) as caught:
            await bad.hear()
        assert caught.value.rcvd.code == code
        await gone.reach(1)
        await good.settled()


async def test_a_message_of_a_hundred_megabytes_is_not_even_read():
    async with server() as robot, peer(robot) as bad, peer(robot) as good:
        await bad.settled()
        bad.ws.transport.write(struct.pack("!BBQ", 0x81, 0x80 | 127, 100_000_000) + b"mask")
        with pytest.raises(ConnectionClosedError) as caught:
            await bad.hear()
        assert caught.value.rcvd.code == 1009
        await good.settled()


async def test_a_client_may_ping_and_close_as_ever():
    gone = Record()
    async with server(on_gone=gone) as robot, peer(robot) as foreign:
        async with asyncio.timeout(TIMEOUT):
            await (await foreign.ws.ping(b"are you there"))
        await foreign.ws.close(1000)
        assert foreign.ws.close_code == 1000
        await gone.reach(1)
        assert robot.operators == set()


async def test_what_was_said_in_the_same_breath_as_goodbye_is_still_heard():
    heard = Record()
    async with server(on_message=heard) as robot, peer(robot) as foreign:
        await foreign.settled()
        rest = Frame(Opcode.TEXT, speed(0.0).encode()).serialize(mask=True)
        goodbye = Frame(Opcode.CLOSE, struct.pack("!H", 1000)).serialize(mask=True)
        foreign.ws.transport.write(rest + goodbye)
        await heard.reach(1)
        assert [msg.linear.x for _, _, msg, _ in heard] == [0.0]


@pytest.mark.parametrize("end", ["cut", "abort"])
async def test_many_operations_in_the_same_breath_as_goodbye_are_all_done_however_it_ends(end, monkeypatch):
    monkeypatch.setattr(serving, "TURN_TIME", 0.0)
    heard, gone = Record(), Record()

    def on_message(session, topic, msg, stamp):
        heard(msg.linear.x)
        if len(heard) == 2:  # the goodbye is read then
            connection = next(iter(robot._open))
            connection.abort() if end == "cut" else connection.transport.abort()

    async with server(on_message=on_message, on_gone=gone) as robot, peer(robot) as foreign:
        await foreign.settled()
        many = Frame(Opcode.TEXT, "".join(speed(float(x)) for x in range(20)).encode()).serialize(mask=True)
        rest = Frame(Opcode.TEXT, speed(0.0).encode()).serialize(mask=True)
        goodbye = Frame(Opcode.CLOSE, struct.pack("!H", 1000)).serialize(mask=True)
        foreign.ws.transport.write(many + rest + goodbye)
        await gone.reach(1)
    assert heard == [*(float(x) for x in range(20)), 0.0]


async def test_a_connection_that_is_over_keeps_nothing_of_what_came():
    began, gone = Record(), Record()
    async with server(on_gone=gone) as robot, peer(robot) as foreign:
        await foreign.settled()
        connection = next(iter(robot._open))
        piece = connection._piece
        connection._piece = lambda *told: began(piece(*told))
        unfinished = Frame(Opcode.TEXT, b"x" * 2000, fin=False).serialize(mask=True)
        foreign.ws.transport.write(unfinished + Frame(Opcode.CONT, b"y" * 2000).serialize(mask=True)[:-1])
        await began.reach(1)
        foreign.ws.transport.abort()
        await gone.reach(1)
        assert connection._pieces == []
        assert connection._handler is None
        assert connection.protocol.reader.buffer == b""


async def test_a_vanished_clients_session_is_over_before_what_it_left_is_tidied_up():
    order = Record()
    async with (
        server(on_gone=lambda _: order("gone"), on_demand=lambda _, wanted: order(wanted)) as robot,
        peer(robot) as foreign,
    ):
        await foreign.say(op="subscribe", topic="/scan")
        await foreign.settled()
        foreign.ws.transport.abort()
        await order.reach(3)
    assert order == [True, "gone", False]


async def test_who_does_not_shake_hands_makes_room_for_others():
    async with (
        server(limits=Limits(3)) as robot,
        peer(robot) as first,
        bare(robot) as oldest,
        bare(robot) as other,
    ):
        await first.settled()
        for _, writer in (oldest, other):
            writer.write(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgr")
        async with peer(robot) as second:
            async with asyncio.timeout(TIMEOUT):
                with contextlib.suppress(ConnectionResetError):
                    assert await oldest[0].read() == b""
            await first.settled()
            await second.settled()
            assert not other[0].at_eof()


async def test_who_comes_when_all_are_busy_may_stop_the_robot_and_nothing_else_until_there_is_room():
    async with server(limits=Limits(2)) as robot, peer(robot) as first:
        await first.settled()
        async with peer(robot) as second:
            await second.settled()
            async with peer(robot) as late:
                assert (await late.call("/rosapi/get_time"))["result"]
                assert (await late.call("/stop"))["values"]["success"]
                answer = await late.call("/rosapi/nodes")
                assert (answer["result"], answer["values"]) == (False, FULL)
                await late.say(op="set_level", level="error")
                await late.say(op="subscribe", topic="/odom")
                assert FULL in (await late.hear())["msg"]
            await first.settled()
            await second.settled()
        async with peer(robot) as third:
            await third.settled()


async def test_a_fault_in_the_server_costs_nobody_the_connection(caplog, monkeypatch):
    async with server() as robot, peer(robot) as foreign:
        monkeypatch.setattr("bridge.server.rosbridge_session.RosbridgeSession._handle", lambda *_: 1 / 0)
        await foreign.say(op="subscribe", topic="/scan")
        async with asyncio.timeout(TIMEOUT):
            await (await foreign.ws.ping())
        monkeypatch.undo()
        await foreign.settled()
    assert "ZeroDivisionError" in caplog.text


async def test_nothing_is_heard_of_a_client_that_was_cut_off():
    heard, gone = Record(), Record()

    def cut(session, topic, msg, stamp):
        heard(msg.linear.x)
        next(iter(robot._open)).abort()

    async with server(on_message=cut, on_gone=gone) as robot, peer(robot) as foreign:
        await foreign.settled()
        said = [Frame(Opcode.TEXT, speed(x).encode()).serialize(mask=True) for x in (1.0, 2.0)]
        foreign.ws.transport.write(b"".join(said))
        await gone.reach(1)
    assert heard == [1.0]


@asynccontextmanager
async def turns():
    """Counts the steps of the loop."""
    step = itertools.count()
    now = [0]

    async def count():
        while True:
            now[0] = next(step)
            await asyncio.sleep(0)

    counting = asyncio.create_task(count())
    try:
        yield now
    finally:
        counting.cancel()
        await asyncio.gather(counting, return_exceptions=True)


def slowly(monkeypatch):
    """Every look at the clock finds that a turn is over."""
    monkeypatch.setattr(server_connection.CallbackConnection, "clock", itertools.count().__next__)


async def test_of_much_that_comes_at_once_each_turn_takes_a_piece(monkeypatch):
    slowly(monkeypatch)
    heard = Record()
    async with turns() as now:
        on_message = lambda session, topic, msg, stamp: heard((now[0], msg.linear.x))  # noqa: E731
        async with server(on_message=on_message) as robot, peer(robot) as foreign:
            await foreign.settled()
            padded = [speed(float(x)).encode() + b" " * 400 for x in range(100)]
            said = b"".join(Frame(Opcode.TEXT, text).serialize(mask=True) for text in padded)
            foreign.ws.transport.write(said)
            await foreign.settled()
    assert [x for _, x in heard] == [float(x) for x in range(100)]
    assert len({turn for turn, _ in heard}) > 90


async def test_the_more_clients_flood_the_robot_the_shorter_is_the_turn_of_each(monkeypatch):
    slowly(monkeypatch)
    turns_at = {}
    async with server() as robot, contextlib.AsyncExitStack() as stack:
        floods = [await stack.enter_async_context(peer(robot)) for _ in range(3 * FULL_TURNS)]
        said = b"".join(Frame(Opcode.TEXT, speed(0.0).encode()).serialize(mask=True) for _ in range(200))
        for flood in floods:
            await flood.settled()
        for flood in floods:
            flood.ws.transport.write(said)
        connection = next(iter(robot._open))
        while len(turns_at) < 3 * FULL_TURNS:
            turns_at[len(robot._batch.crowd)] = connection._turn
            await asyncio.sleep(0)
            if not robot._batch.crowd and len(turns_at) > 1:
                break
        for flood in floods:
            await flood.settled()
        assert robot._batch.crowd == set()
    whole = server_connection.TURN_TIME
    assert max(turns_at) > FULL_TURNS
    assert all(
        turn == pytest.approx(whole * min(1.0, FULL_TURNS / max(1, crowd)))
        for crowd, turn in turns_at.items()
    )


async def test_who_is_cut_off_with_more_to_say_is_no_longer_of_the_crowd(monkeypatch):
    slowly(monkeypatch)
    gone = Record()
    async with server(on_gone=gone) as robot, peer(robot) as foreign:
        await foreign.settled()
        said = b"".join(Frame(Opcode.TEXT, speed(0.0).encode()).serialize(mask=True) for _ in range(500))
        foreign.ws.transport.write(said)
        for _ in range(10_000):
            await asyncio.sleep(0)
            if robot._batch.crowd:
                break
        assert robot._batch.crowd
        foreign.ws.transport.abort()
        await gone.reach(1)
        assert robot._batch.crowd == set()


async def test_operations_of_one_frame_are_done_in_turns_and_what_follows_waits_for_them(monkeypatch):
    monkeypatch.setattr(serving, "TURN_TIME", 0.0)
    heard = Record()
    async with turns() as now:
        on_message = lambda session, topic, msg, stamp: heard((now[0], msg.linear.x))  # noqa: E731
        async with server(on_message=on_message) as robot, peer(robot) as foreign:
            await foreign.ws.send("".join(speed(float(x)) for x in range(20)))
            await foreign.ws.send("".join(speed(float(x)) for x in range(20, 40)))
            await foreign.ws.send(speed(40.0))
            await foreign.settled()
    assert [x for _, x in heard] == [float(x) for x in range(41)]
    assert len({turn for turn, _ in heard}) > 35


async def test_a_long_frame_that_comes_with_the_handshake_is_done_to_its_end(monkeypatch):
    monkeypatch.setattr(serving, "TURN_TIME", 0.0)
    heard = Record()
    async with server(on_message=heard) as robot, bare(robot) as (_, writer):
        text = "".join(speed(float(x)) for x in range(10)).encode()
        writer.write(HANDSHAKE + Frame(Opcode.TEXT, text).serialize(mask=True))
        await heard.reach(10)
    assert [msg.linear.x for _, _, msg, _ in heard] == [float(x) for x in range(10)]
