"""Connections to the web site, on loopback."""

from __future__ import annotations

import asyncio
from pathlib import Path

import httpx
import pytest

from robotside import visit
from tests.fakes import FakeRobot
from tests.robotside.test_serving import serving


async def end_of(reader: asyncio.StreamReader) -> bytes:
    try:
        async with asyncio.timeout(5):
            return await reader.read()
    except ConnectionResetError:
        return b""


@pytest.mark.parametrize("said", [b"", b"GET / HT", b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n"])
async def test_a_connection_that_does_not_end_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, said: bytes
) -> None:
    monkeypatch.setattr(visit, "LONGEST", 0.2)
    async with serving(tmp_path, FakeRobot()) as serves:
        reader, writer = await asyncio.open_connection("127.0.0.1", serves.addresses.http_port)
        writer.write(said)
        assert (b"200 OK" in await end_of(reader)) is said.endswith(b"\r\n\r\n")
        writer.close()


async def test_one_connection_too_many_is_closed_and_room_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(visit, "MOST", 2)
    async with (
        serving(tmp_path, FakeRobot()) as serves,
        httpx.AsyncClient(base_url=serves.addresses.http) as web,
    ):
        idle = [await asyncio.open_connection("127.0.0.1", serves.addresses.http_port) for _ in range(3)]
        assert await end_of(idle[-1][0]) == b""
        for _, writer in idle:
            writer.close()
            await writer.wait_closed()
        async with asyncio.timeout(5):
            while True:
                try:
                    answer = await web.get("/healthz")
                    break
                except httpx.TransportError:
                    continue
        assert answer.json()["ok"] is True
