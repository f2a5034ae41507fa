"""Connections to the web site, on loopback."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from bridge.server.reception.places import FULL, Limits
from robotside.gateways.http import browser_connection as visit
from robotside.gateways.http import gateway
from tests.fakes import FakeRobot
from tests.robotside.gateways.http.test_camera_streams import filming, looking
from tests.robotside.serving.test_station_server import serving
from tests.robotside.visitor import visitor


async def end_of(reader: asyncio.StreamReader) -> bytes:
    try:
        async with asyncio.timeout(60):
            return await reader.read()
    except ConnectionResetError:
        return b""


@pytest.mark.parametrize("said", [b"", b"GET / HT", b"GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"])
async def test_a_connection_that_does_not_end_is_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, said: bytes
) -> None:
    monkeypatch.setattr(visit, "MAX_CONNECTION_TIME", 0.2)
    async with serving(tmp_path, FakeRobot()) as serves:
        reader, writer = await asyncio.open_connection("127.0.0.1", serves.addresses.http_port)
        writer.write(said)
        assert (b"200 OK" in await end_of(reader)) is said.endswith(b"\r\n\r\n")
        writer.close()


async def test_for_one_connection_too_many_the_oldest_that_asks_nothing_is_closed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gateway, "LIMITS", Limits(total=2))
    async with (
        serving(tmp_path, FakeRobot()) as serves,
        visitor(serves.addresses.http) as web,
    ):
        slow = [await asyncio.open_connection("127.0.0.1", serves.addresses.http_port) for _ in range(2)]
        for _, writer in slow:
            writer.write(b"GET / HT")
        assert (await web.get("/healthz")).json()["ok"] is True
        assert await end_of(slow[0][0]) == b""
        slow[1][1].write(b"TP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")
        assert b"200 OK" in await end_of(slow[1][0])
        for _, writer in slow:
            writer.close()


async def test_while_all_others_are_answered_one_too_many_may_press_stop_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(gateway, "LIMITS", Limits(total=1))
    async with filming(tmp_path) as (robot, serves, web), looking(web):
        await robot.until(True)
        async with visitor(serves.addresses.http) as late:
            answer = await late.get("/healthz")
            assert (answer.status_code, answer.text) == (503, f"{FULL}\n")
            assert (await late.post("/stop")).status_code == 200
        assert serves.station.controls.stopped


async def test_a_body_that_turns_out_to_be_none_after_its_answer_ends_the_connection(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    async with serving(tmp_path, FakeRobot()) as serves:
        reader, writer = await asyncio.open_connection("127.0.0.1", serves.addresses.http_port)
        writer.write(b"POST /healthz HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n")
        assert b" 405 " in await reader.readuntil(b"\r\n\r\n")
        writer.write(b"no chunk\r\n")
        await end_of(reader)
        writer.close()
    assert not [record for record in caplog.records if record.exc_info]
