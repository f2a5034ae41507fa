"""One open WebSocket, and what is asked of the system for it."""

from __future__ import annotations

import asyncio

from websockets.asyncio.server import serve

from bridge.client import connection
from tests.bridge.wires import Record, server, url


async def test_what_came_is_acknowledged_at_once_even_if_it_is_half_a_message(monkeypatch):
    """A server that waits for acknowledgements before it sends small packets would hold the rest back for 40 ms."""
    asked, go = Record(), asyncio.Event()
    monkeypatch.setattr(connection, "_acknowledge_at_once", asked)

    async def say(ws):
        await ws.send("1")
        await go.wait()
        ws.transport.write(b"\x81\x04ha")
        go.clear()
        await go.wait()
        ws.transport.write(b"lf")
        await ws.wait_closed()

    async with serve(say, "127.0.0.1", 0, close_timeout=0.1) as listening:
        made = await connection.open_connection(
            f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}", 5.0
        )
        arriving = made.messages()
        assert await anext(arriving) == b"1"
        assert asked[-1] == made._socket
        for _ in range(2):
            asked.clear()
            go.set()
            await asked.reach(1)
        assert await anext(arriving) == b"half"
        await made.close()


async def test_a_server_of_ours_says_so_and_others_do_not():
    async def nothing(ws):
        await ws.wait_closed()

    async with server() as robot, serve(nothing, "127.0.0.1", 0, close_timeout=0.1) as listening:
        ours = await connection.open_connection(url(robot), 5.0)
        other = await connection.open_connection(
            f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}", 5.0
        )
        assert (ours.ours, other.ours) == (True, False)
        assert (ours.local, ours.address) == ("127.0.0.1", ("127.0.0.1", robot.port))
        await ours.close()
        await other.close()


async def test_a_ping_is_answered_and_a_second_one_waits_for_the_first():
    answered = Record()

    async def nothing(ws):
        await ws.wait_closed()

    async with serve(nothing, "127.0.0.1", 0, close_timeout=0.1) as listening:
        made = await connection.open_connection(
            f"ws://127.0.0.1:{listening.sockets[0].getsockname()[1]}", 5.0
        )
        listen = asyncio.create_task(anext(made.messages(), None))
        made.ping(lambda: answered("first"))
        made.ping(lambda: answered("second"))
        assert await answered.reach(1) == ["first"]
        await asyncio.sleep(0)
        made.ping(lambda: answered("third"))
        assert await answered.reach(2) == ["first", "third"]
        await made.close()
        await listen


async def test_after_the_end_nothing_is_sent():
    async with server() as robot:
        made = await connection.open_connection(url(robot), 5.0)
        assert made.send("{}")
        await made.close()
        assert not made.send("{}")
