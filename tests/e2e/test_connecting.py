"""Connecting to what is there and to what is not: each failure is one plain sentence on the glass."""

from __future__ import annotations

import asyncio
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from websockets.asyncio.server import serve

from tests.e2e.handheld import Handheld, handheld


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@contextmanager
def chatterbox() -> Iterator[int]:
    """A WebSocket server that is no rosbridge: it says hello and listens to nothing."""
    loop, stop, ready, ports = asyncio.new_event_loop(), asyncio.Event(), threading.Event(), []

    async def speak(socket_: object) -> None:
        await socket_.send("hello")  # type: ignore[attr-defined]
        await socket_.wait_closed()  # type: ignore[attr-defined]

    async def main() -> None:
        async with serve(speak, "127.0.0.1", 0, close_timeout=0.2) as server:
            ports.append(server.sockets[0].getsockname()[1])
            ready.set()
            await stop.wait()

    thread = threading.Thread(target=loop.run_until_complete, args=(main(),))
    thread.start()
    ready.wait(5)
    try:
        yield ports[0]
    finally:
        loop.call_soon_threadsafe(stop.set)
        thread.join(5)
        loop.close()


def says(glass: Handheld, *parts: str) -> str:
    """Wait for words on the glass that hold all `parts`."""
    return glass.until(
        lambda: next((w for w in glass.words() if all(part in w for part in parts)), ""),
        f"words with {parts}",
    )


def test_nobody_listening_is_said_with_the_address(tmp_path: Path) -> None:
    port = free_port()
    with handheld(tmp_path, url=f"ws://127.0.0.1:{port}", discover=False) as glass:
        assert says(glass, f"127.0.0.1:{port}")


def test_a_server_that_is_no_rosbridge_is_said(tmp_path: Path) -> None:
    with chatterbox() as port, handheld(tmp_path, url=f"ws://127.0.0.1:{port}", discover=False) as glass:
        assert says(glass, "is a WebSocket but no robot")


@pytest.mark.parametrize("typed", ["not an address", "http://10.0.0.3:9090", "ws://10.0.0.3:99999"])
def test_an_address_that_is_none_stays_in_the_field_with_a_sentence(typed: str, tmp_path: Path) -> None:
    with handheld(tmp_path, discover=False) as glass:
        glass.tap("Add by address")
        field = glass.one("TextInput")
        field.text = typed
        glass.tap("Connect")
        glass.run(0.2)
        assert field.text == typed
        assert glass.app.session is None
        assert any(typed in words or "ws://" in words for words in glass.words() if words != typed)
