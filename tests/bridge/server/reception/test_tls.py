"""TLS under a protocol: flow control means the same as without, and one write is encrypted at once."""

from __future__ import annotations

import asyncio
import socket
import ssl
from pathlib import Path

from bridge.msgs.nav_msgs import Odometry
from bridge.server.reception.tls import harden, unsent, upgrade
from tests.bridge.server.reception.test_reception import secret, secured
from tests.bridge.wires import TIMEOUT
from tests.certificates import client_context, tls


class Writer(asyncio.Protocol):
    """Notes how much waits in the process whenever its flow is controlled."""

    def __init__(self) -> None:
        self.paused: asyncio.Event = asyncio.Event()
        self.resumed: asyncio.Event = asyncio.Event()
        self.below: asyncio.Transport | None = None
        self.left: list[int] = []
        self.is_paused = False

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        self.transport = transport
        transport.set_write_buffer_limits(65536)  # as libraries do

    def pause_writing(self) -> None:
        assert not self.is_paused
        self.is_paused = True
        self.paused.set()

    def resume_writing(self) -> None:
        assert self.is_paused
        self.is_paused = False
        self.left.append(unsent(self.transport, self.below))
        self.resumed.set()


class Listener(asyncio.Protocol):
    """Upgrades each connection."""

    def __init__(self, context: ssl.SSLContext, writer: Writer) -> None:
        self._context, self._writer = context, writer
        self.done: asyncio.Task[asyncio.Transport] | None = None

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        assert isinstance(transport, asyncio.Transport)
        transport.get_extra_info("socket").setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 16384)
        self._writer.below = transport
        self.done = asyncio.create_task(upgrade(transport, self._writer, self._context))


async def test_it_is_told_that_all_has_left_only_when_neither_tls_nor_the_socket_holds_anything(
    tmp_path: Path,
) -> None:
    writer = Writer()
    listener = Listener(tls(tmp_path), writer)
    loop = asyncio.get_running_loop()
    server = await loop.create_server(lambda: listener, "127.0.0.1", 0)
    port = server.sockets[0].getsockname()[1]
    reader, outgoing = await asyncio.open_connection("127.0.0.1", port, ssl=client_context(), limit=4096)
    async with asyncio.timeout(TIMEOUT):
        assert listener.done is not None
        await listener.done
        written = 0
        while not writer.is_paused:
            writer.transport.write(bytes(10_000))
            written += 10_000
        assert unsent(writer.transport, writer.below) > 0
        for _ in range(3):  # what is urgent is written all the same
            writer.transport.write(bytes(10_000))
            written += 10_000
        await reader.readexactly(written)
        await writer.resumed.wait()
    assert writer.left == [0]
    writer.transport.abort()
    outgoing.close()
    server.close()
    await server.wait_closed()


async def test_for_a_slow_reader_a_newer_message_replaces_one_that_waits(tmp_path: Path) -> None:
    async with secured(tls(tmp_path)) as robot, secret(robot, max_queue=1) as slow:
        await slow.say(op="subscribe", topic="/odom", type="nav_msgs/Odometry")
        await slow.settled()
        slow.ws.transport.pause_reading()
        (connection,) = robot._open
        most = 0
        for number in range(3000):
            robot.publish("/odom", Odometry(child_frame_id=f"{number} " + "x" * 5000))
            await asyncio.sleep(0)
            most = max(most, unsent(connection.transport, connection.below))  # type: ignore[attr-defined]
        assert most < 1_000_000
        slow.ws.transport.resume_reading()
        heard = []
        while not heard or heard[-1] != 2999:
            heard.append(int((await slow.hear())["msg"]["child_frame_id"].split()[0]))
        assert heard == sorted(heard)
        assert len(heard) < 2000


def test_a_context_takes_nothing_below_tls_1_2(tmp_path: Path) -> None:
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.MINIMUM_SUPPORTED
    assert harden(context).minimum_version is ssl.TLSVersion.TLSv1_2
    assert context.options & ssl.OP_NO_RENEGOTIATION
    assert context.options & ssl.OP_NO_COMPRESSION
    context.minimum_version = ssl.TLSVersion.TLSv1_3
    assert harden(context).minimum_version is ssl.TLSVersion.TLSv1_3
