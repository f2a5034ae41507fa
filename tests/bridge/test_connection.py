"""One open WebSocket, and what is asked of the system for it."""

from __future__ import annotations

import asyncio

from websockets.asyncio.server import serve

from bridge import connection
from tests.bridge.wires import Record, server, url


async def test_each_message_that_came_is_acknowledged_at_once(monkeypatch):
    """A server that waits for acknowledgements before it sends small packets would hold answers back for 40 ms."""
    asked = Record()
    monkeypatch.setattr(connection, "_acknowledge_at_once", asked)

    async def say(ws):
        for text in ("1", "2", "3"):
            await ws.send(text)

    async with serve(say, "127.0.0.1", 0) as listening:
        made = await connection.dial(f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}", 5.0)
        assert [raw async for raw in made.arriving()] == [b"1", b"2", b"3"]
        assert asked == [made._socket] * 3
        await made.hang_up()


async def test_a_server_of_ours_says_so_and_others_do_not():
    async def nothing(ws):
        await ws.wait_closed()

    async with server() as robot, serve(nothing, "127.0.0.1", 0, close_timeout=0.1) as listening:
        ours = await connection.dial(url(robot), 5.0)
        other = await connection.dial(f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}", 5.0)
        assert (ours.ours, other.ours) == (True, False)
        assert (ours.local, ours.address) == ("127.0.0.1", ("127.0.0.1", robot.port))
        await ours.hang_up()
        await other.hang_up()


async def test_a_ping_is_answered_and_a_second_one_waits_for_the_first():
    answered = Record()

    async def nothing(ws):
        await ws.wait_closed()

    async with serve(nothing, "127.0.0.1", 0, close_timeout=0.1) as listening:
        made = await connection.dial(f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}", 5.0)
        listen = asyncio.create_task(anext(made.arriving(), None))
        made.ping(lambda: answered("first"))
        made.ping(lambda: answered("second"))
        assert await answered.reach(1) == ["first"]
        await asyncio.sleep(0)
        made.ping(lambda: answered("third"))
        assert await answered.reach(2) == ["first", "third"]
        await made.hang_up()
        await listen


async def test_after_the_end_nothing_is_sent():
    async with server() as robot:
        made = await connection.dial(url(robot), 5.0)
        assert made.post("{}")
        await made.hang_up()
        assert not made.post("{}")
