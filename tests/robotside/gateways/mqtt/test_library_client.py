"""The library's socket in the loop: one that is gone by the loop's next step is left alone, and so is who has its number then."""

from __future__ import annotations

import asyncio
import os
import socket
from collections.abc import Iterator
from typing import Any

import pytest

from robotside.gateways.mqtt.library_client import LibraryClient


class _Paho:
    """Writes what there is to write."""

    def __init__(self, fault: Exception | None = None) -> None:
        self.writes, self.fault = 0, fault

    def loop_write(self) -> None:
        self.writes += 1
        if self.fault is not None:
            raise self.fault


@pytest.fixture
def ends() -> Iterator[tuple[socket.socket, socket.socket]]:
    pair = socket.socketpair()
    yield pair
    for end in pair:
        end.close()


@pytest.fixture
async def faults() -> list[dict[str, Any]]:
    """What the loop would print."""
    said: list[dict[str, Any]] = []
    asyncio.get_running_loop().set_exception_handler(lambda _, about: said.append(about))
    return said


async def test_the_library_calls_what_is_overridden_here() -> None:
    client = LibraryClient("127.0.0.1")
    for name in ("_on_socket_register_write", "_on_socket_unregister_write"):
        used = getattr(client._client, name.removeprefix("_"))
        assert used == getattr(client, name)
        assert used.__func__ is getattr(LibraryClient, name)


async def test_a_socket_that_is_gone_by_the_next_step_says_nothing(
    ends: tuple[socket.socket, socket.socket], faults: list[dict[str, Any]]
) -> None:
    client, paho, sock = LibraryClient("127.0.0.1"), _Paho(), ends[0]
    client._on_socket_register_write(paho, None, sock)  # type: ignore[arg-type]
    sock.close()  # as the library does when it reads in the same step that the broker is gone
    for _ in range(3):
        await asyncio.sleep(0)
    assert (paho.writes, faults) == (0, [])


async def test_a_file_that_has_its_number_by_then_is_not_watched(
    ends: tuple[socket.socket, socket.socket], faults: list[dict[str, Any]]
) -> None:
    client, paho, sock = LibraryClient("127.0.0.1"), _Paho(), ends[0]
    client._on_socket_register_write(paho, None, sock)  # type: ignore[arg-type]
    number = sock.fileno()
    client._on_socket_unregister_write(paho, None, sock)  # type: ignore[arg-type]
    sock.close()
    another = os.dup2(ends[1].fileno(), number)  # which could be written to at once
    try:
        for _ in range(3):
            await asyncio.sleep(0)
        assert (paho.writes, faults) == (0, [])
        assert not asyncio.get_running_loop().remove_writer(number)
    finally:
        os.close(another)


async def test_what_there_is_to_write_is_written_until_all_is(
    ends: tuple[socket.socket, socket.socket], faults: list[dict[str, Any]]
) -> None:
    client, paho, sock = LibraryClient("127.0.0.1"), _Paho(), ends[0]
    client._on_socket_register_write(paho, None, sock)  # type: ignore[arg-type]
    async with asyncio.timeout(60):
        while paho.writes < 2:  # noqa: ASYNC110 - what is waited for is no event
            await asyncio.sleep(0)
    client._on_socket_unregister_write(paho, None, sock)  # type: ignore[arg-type]
    written = paho.writes
    for _ in range(3):
        await asyncio.sleep(0)
    assert (paho.writes, faults) == (written, [])


async def test_a_write_that_fails_ends_the_connection_and_is_not_printed(
    ends: tuple[socket.socket, socket.socket], faults: list[dict[str, Any]]
) -> None:
    broken = BrokenPipeError("gone")
    client, paho, sock = LibraryClient("127.0.0.1"), _Paho(broken), ends[0]
    client._on_socket_register_write(paho, None, sock)  # type: ignore[arg-type]
    async with asyncio.timeout(60):
        while not paho.writes:  # noqa: ASYNC110 - what is waited for is no event
            await asyncio.sleep(0)
    client._on_socket_unregister_write(paho, None, sock)  # type: ignore[arg-type]
    assert (client._disconnected.exception(), faults) == (broken, [])
