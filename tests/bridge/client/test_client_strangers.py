"""The client and what answers at a robot's address and is no robot, or hardly one."""

from __future__ import annotations

import asyncio
import json
import math

import pytest
from websockets.asyncio.server import serve

from bridge.client import heartbeat
from bridge.client.client import Phase
from bridge.msgs.nav_msgs import Odometry
from tests.bridge.wires import Clock, Record, link


@pytest.fixture(autouse=True)
def quick_pings(monkeypatch):
    monkeypatch.setattr(heartbeat, "PING_PERIOD", 0.02)


async def stranger(answer: bytes):
    async def serve_one(reader, writer):
        await reader.readuntil(b"\r\n\r\n")
        writer.write(answer)
        writer.close()

    return await asyncio.start_server(serve_one, "127.0.0.1", 0)


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (b"SSH-2.0-OpenSSH_9.2\r\n", "it does not speak WebSocket"),
        (b"", "it does not speak WebSocket"),
        (b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n", "HTTP 404"),
        (b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nhi", "HTTP 200"),
    ],
)
async def test_what_is_no_websocket_is_one_sentence(answer, reason):
    async with await stranger(answer) as listening:
        port = listening.sockets[0].getsockname()[1]
        async with link(f"ws://127.0.0.1:{port}") as made:
            sentence = await made.sentence(Phase.WAITING)
            assert sentence == f"What answers at 127.0.0.1:{port} is no robot ({reason})."


async def echo(ws, first):
    await ws.send(first)
    async for text in ws:
        await ws.send(text)


async def chatter(ws, first):
    for text in ("hello", b"\x80", "{}", '{"op":"publish","topic":"/x"}', '{"op":"service_response"}'):
        await ws.send(text)
    await ws.wait_closed()


@pytest.mark.parametrize("manner", [echo, chatter])
async def test_a_websocket_that_is_no_rosbridge_is_one_sentence(manner):
    clock, met = Clock(), Record()

    async def meet(ws):
        first = await ws.recv()
        met(first)
        await manner(ws, first)

    async with serve(meet, "127.0.0.1", 0, close_timeout=0.1) as listening:
        place = f"127.0.0.1:{listening.sockets[0].getsockname()[1]}"
        async with link(f"ws://{place}", now=clock) as made:
            await met.reach(1)
            clock.time += 3.0
            sentence = await made.sentence(Phase.WAITING)
            assert sentence == f"{place} is a WebSocket but no robot: it did not answer within 3 s."


async def test_a_websocket_that_answers_nothing_but_pings_is_in_the_end_taken_for_a_robot():
    clock, met = Clock(), Record()

    async def meet(ws):
        met(await ws.recv())
        await ws.wait_closed()

    async with serve(meet, "127.0.0.1", 0, close_timeout=0.1) as listening:
        place = f"127.0.0.1:{listening.sockets[0].getsockname()[1]}"
        async with link(f"ws://{place}", now=clock) as made:
            await met.reach(1)
            for _ in range(3):
                await made.heard_at(clock.time)  # pings are answered meanwhile
                assert made.client.state.phase is Phase.CONNECTING
                clock.time += 1.0
            sentence = await made.sentence(Phase.CONNECTED)
            assert sentence == f"Connected to {place}, which does not report its time."


async def test_a_rosbridge_without_rosapi_is_a_robot_whose_clock_is_not_known():
    async def bare(ws):
        async for text in ws:
            op = json.loads(text)
            if op["op"] == "call_service":
                no = {"op": "service_response", "id": op["id"], "service": op["service"]}
                await ws.send(json.dumps(no | {"result": False, "values": "no such service"}))

    async with serve(bare, "127.0.0.1", 0) as listening:
        port = listening.sockets[0].getsockname()[1]
        async with link(f"ws://127.0.0.1:{port}") as made:
            client = await made.connected()
            assert client.rtt > 0, "it was measured"
            assert math.isnan(client.offset)


async def test_a_malformed_message_is_left_out_and_told_once(caplog):
    heard = Record()

    async def sloppy(ws):
        async for text in ws:
            op = json.loads(text)
            if op["op"] == "call_service":
                answer = {"op": "service_response", "id": op["id"], "values": {}, "result": True}
                await ws.send(json.dumps(answer))
            if op["op"] == "subscribe":
                for x in ("far", "farther", 1.5):
                    msg = {"pose": {"pose": {"position": {"x": x}}}}
                    await ws.send(json.dumps({"op": "publish", "topic": "/odom", "msg": msg}))

    async with serve(sloppy, "127.0.0.1", 0) as listening:  # noqa: SIM117 -- the address comes from the first
        async with link(f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}") as made:
            made.client.subscribe("/odom", Odometry, heard)
            await heard.reach(1)
            assert heard[0][0].pose.pose.position.x == 1.5
    assert caplog.text.count("is left out: pose.pose.position.x must be a number or null") == 1
