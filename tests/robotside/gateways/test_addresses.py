"""Addresses under which others reach a listening socket."""

from __future__ import annotations

import asyncio
import socket

import pytest

from robotside.gateways import addresses
from robotside.gateways.addresses import listening_socket, url


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("192.0.2.7", "ws://192.0.2.7:9090"),
        ("robot.local", "ws://robot.local:9090"),
        ("2001:db8::7", "ws://[2001:db8::7]:9090"),
    ],
)
def test_a_host_is_given_to_others_as_it_is(host: str, expected: str) -> None:
    assert url("ws", host, 9090) == expected


@pytest.mark.parametrize("everywhere", ["0.0.0.0", "::", ""])
def test_for_all_hosts_the_machines_own_address_is_given(
    everywhere: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(addresses, "_own_address", lambda: "192.0.2.9")
    assert url("http", everywhere, 8080) == "http://192.0.2.9:8080"


def test_a_socket_listens_where_it_is_asked_to_and_a_taken_port_fails() -> None:
    with listening_socket("127.0.0.1", 0) as first:
        port = first.getsockname()[1]
        with socket.create_connection(("127.0.0.1", port), timeout=5):
            pass
        with pytest.raises(OSError, match="in use"):
            listening_socket("127.0.0.1", port)


def test_beyond_this_machine_a_server_with_tls_is_reached_by_it() -> None:
    assert url("ws", "127.0.0.1", 9090, tls=True) == "ws://127.0.0.1:9090"
    assert url("http", "localhost", 8080, tls=True) == "http://localhost:8080"
    assert url("ws", "192.168.1.7", 9090, tls=True) == "wss://192.168.1.7:9090"
    assert url("http", "robot.local", 8080, tls=True) == "https://robot.local:8080"
    assert url("ws", "192.168.1.7", 9090) == "ws://192.168.1.7:9090"


async def test_what_is_sent_to_who_comes_leaves_at_once() -> None:
    came: asyncio.Future[int] = asyncio.get_running_loop().create_future()

    def look(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        own = writer.get_extra_info("socket")
        came.set_result(own.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY))
        writer.close()

    with listening_socket("127.0.0.1", 0) as listener:
        server = await asyncio.start_server(look, sock=listener)
        _, writer = await asyncio.open_connection(*listener.getsockname())
        assert await came != 0
        writer.close()
        server.close()
