"""Connections before their protocol speaks: TLS or plain on one port, who is turned away, and who never says anything."""

from __future__ import annotations

import asyncio
import contextlib
import ssl
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

from bridge.server.reception import reception as module
from bridge.server.reception.places import Limits, Place
from bridge.server.reception.reception import neighbourhood, plain_host
from bridge.server.server import BridgeServer
from tests.bridge.peers import Peer, bare, peer
from tests.bridge.wires import TIMEOUT, Record, door
from tests.certificates import client_context, tls

SMALL = Limits(total=8, per_address=6, per_identity=4, reserve=4)


@pytest.fixture
def context(tmp_path: Path) -> ssl.SSLContext:
    return tls(tmp_path)


def nobody(_: str) -> bool:
    return False


@asynccontextmanager
async def secured(
    context: ssl.SSLContext, limits: Limits = SMALL, **how: object
) -> AsyncIterator[BridgeServer]:
    """A server that speaks TLS, and plain as well unless told otherwise."""
    doors = {"on_gone": Record()}
    made = BridgeServer(door(doors), limits=limits)
    await made.start(port=0, tls=context, **how)  # type: ignore[arg-type]
    try:
        yield made
    finally:
        await made.close()


@asynccontextmanager
async def secret(robot: BridgeServer, path: str = "", **options: object) -> AsyncIterator[Peer]:
    """A client that comes by TLS."""
    where = f"wss://127.0.0.1:{robot.port}{path}"
    options = {"ssl": client_context(), "compression": None, "proxy": None, "close_timeout": 0.1} | options
    async with connect(where, **options) as ws:  # type: ignore[arg-type]
        yield Peer(ws)


async def heard_to_the_end(reader: asyncio.StreamReader) -> bytes:
    async with asyncio.timeout(TIMEOUT):
        try:
            return await reader.read()
        except ConnectionResetError:
            return b""


async def nobody_left(robot: BridgeServer) -> None:
    async with asyncio.timeout(TIMEOUT):
        while len(robot._listener.reception.places):  # noqa: ASYNC110 - the loop has to go round
            await asyncio.sleep(0)


async def test_tls_and_plain_come_in_by_the_same_port(context: ssl.SSLContext) -> None:
    async with secured(context) as robot, peer(robot) as plain, secret(robot) as safe:
        await plain.settled()
        await safe.settled()
        ways = {operator.secure for operator in robot.operators}
        assert ways == {True, False}
        assert safe.ws.transport.get_extra_info("ssl_object").version() in ("TLSv1.2", "TLSv1.3")


async def test_who_may_not_come_plain_is_told_in_one_answer_where_to_go(context: ssl.SSLContext) -> None:
    async with secured(context, plain_from=nobody) as robot:
        with pytest.raises(InvalidStatus) as caught:
            async with peer(robot):
                pass
        answer = caught.value.response
        assert answer.status_code == 426
        assert f"wss://127.0.0.1:{robot.port}" in answer.body.decode()
        async with secret(robot) as safe:
            await safe.settled()


async def test_who_is_turned_away_and_sends_on_is_cut(
    context: ssl.SSLContext, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "_LINGER_TIME", 3600.0)
    async with secured(context, plain_from=nobody) as robot, bare(robot) as (reader, writer):
        writer.write(b"GET / HTTP/1.1\r\n")
        assert b" 426 " in await reader.readline()
        assert len(robot._listener.reception.places) == 1, "it has time to read why"
        writer.write(b"x" * (module._MAX_IGNORED_BYTES + 1))
        await nobody_left(robot)


async def test_what_comes_with_the_last_message_of_the_handshake_is_not_lost(context: ssl.SSLContext) -> None:
    async with secured(context) as robot:
        incoming, outgoing = ssl.MemoryBIO(), ssl.MemoryBIO()
        client = client_context().wrap_bio(incoming, outgoing)
        async with bare(robot) as (reader, writer):
            with pytest.raises(ssl.SSLWantReadError):
                client.do_handshake()
            writer.write(outgoing.read())
            async with asyncio.timeout(TIMEOUT):
                while True:
                    incoming.write(await reader.read(65536))
                    with contextlib.suppress(ssl.SSLWantReadError):
                        client.do_handshake()
                        break
                client.write(b"GET /nothing HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n")
                writer.write(outgoing.read())  # the end of the handshake and a request in one piece
                answer = b""
                while b"426" not in answer:
                    incoming.write(await reader.read(65536))
                    with contextlib.suppress(ssl.SSLWantReadError):
                        answer += client.read(65536)


@pytest.mark.parametrize("hello", [b"\x16", b"\x16\x03\x01\x00\x05hello", b"\x16" * 4000])
async def test_a_handshake_that_is_none_or_stops_halfway_is_ended(
    context: ssl.SSLContext, hello: bytes, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("bridge.server.reception.tls.HANDSHAKE_TIMEOUT", 0.05)
    async with secured(context) as robot, bare(robot) as (reader, writer):
        writer.write(hello)
        await heard_to_the_end(reader)
        await nobody_left(robot)
    assert "Traceback" not in caplog.text
    assert not caplog.records


async def test_one_that_says_nothing_is_cut(context: ssl.SSLContext, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "FIRST_BYTE_TIMEOUT", 0.02)
    async with secured(context) as robot, bare(robot) as (reader, _):
        assert await heard_to_the_end(reader) == b""
        assert len(robot._listener.reception.places) == 0


async def test_one_on_the_reserve_is_cut_when_its_time_is_over(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "RESERVE_TIME", 0.02)
    made = BridgeServer(door({}), limits=Limits(total=1))
    await made.start(port=0)
    async with peer(made) as first:
        await first.settled()
        async with bare(made) as (reader, _):
            assert await heard_to_the_end(reader) == b""
        await first.settled()
    await made.close()


async def test_one_that_hangs_up_at_once_leaves_nothing(
    context: ssl.SSLContext, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with secured(context) as robot:
        came, arrive = Record(), robot._listener.reception.places.arrive

        def arrived(host: str, give_up: Callable[[], None]) -> Place:
            came(host)
            return arrive(host, give_up)

        monkeypatch.setattr(robot._listener.reception.places, "arrive", arrived)
        for said in (b"", b"\x16", b"G"):
            async with bare(robot) as (_, writer):
                writer.write(said)
        await came.reach(3)
        await nobody_left(robot)


async def test_the_server_ends_with_connections_in_every_state(context: ssl.SSLContext) -> None:
    async with contextlib.AsyncExitStack() as opened:
        robot = await opened.enter_async_context(secured(context))
        for said in (b"", b"\x16\x03\x01", b"GET"):
            _, writer = await opened.enter_async_context(bare(robot))
            writer.write(said)
        async with secret(robot) as safe:
            await safe.settled()
            await robot.close()
        assert len(robot._listener.reception.places) == 0


def test_an_address_of_ipv6_counts_with_its_network_and_one_of_ipv4_alone() -> None:
    assert neighbourhood("2001:db8::1") == neighbourhood("2001:db8::2") != neighbourhood("2001:db8:1::1")
    assert neighbourhood("192.0.2.1") != neighbourhood("192.0.2.2")
    assert (plain_host("::ffff:192.0.2.1"), plain_host("fe80::1%eth0")) == ("192.0.2.1", "fe80::1")
    assert (plain_host("a name"), neighbourhood("a name")) == ("a name", "a name")
