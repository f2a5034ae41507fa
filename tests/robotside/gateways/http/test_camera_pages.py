"""The camera by URL: film that a player reads, for several at once, by real HTTP."""

from __future__ import annotations

import asyncio
import io
import socket
import sys
import threading
from collections.abc import AsyncIterator
from contextlib import aclosing, asynccontextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest
from PIL import Image

from bridge.core.errors import Refused
from robotside.gateways.http import browser_connection as visit
from robotside.gateways.http import camera_streams as streams
from robotside.gateways.http.camera_pages import delay_words
from robotside.gateways.video import shared_encodings
from robotside.gateways.video.delays import Delays
from robotside.gateways.video.video_encoder import VideoEncoder
from robotside.serving.station_server import StationServer
from tests.lacking import package
from tests.robotside.gateways.http.test_camera_streams import filming, shoot
from tests.robotside.gateways.scaling.test_picture_scaling import PHOTO
from tests.robotside.gateways.video.scenes import Seen, numbered, seen

KINDS = ["front.mp4", "front.webm", "front.webm?codec=vp9"]


class Player:
    """What has come of a film."""

    def __init__(self, answer: httpx.Response, chunks: AsyncIterator[bytes]) -> None:
        self._chunks, self.film = chunks, b""
        self.media_type = answer.headers["content-type"]

    async def read(self) -> None:
        async with asyncio.timeout(60):
            self.film += await anext(self._chunks)

    async def until(self, *numbers: int) -> list[Seen]:
        """What a player sees, as soon as it has seen pictures with these numbers at the end."""
        while True:
            await self.read()
            pictures = seen(self.film)
            if [each.number for each in pictures[-len(numbers) :]] == [*numbers]:
                return pictures


@asynccontextmanager
async def playing(web: httpx.AsyncClient, place: str) -> AsyncIterator[Player]:
    async with web.stream("GET", f"/stream/{place}") as answer, aclosing(answer.aiter_bytes()) as chunks:
        assert answer.status_code == 200, await answer.aread()
        yield Player(answer, chunks)


@pytest.fixture(autouse=True)
def _library(monkeypatch: pytest.MonkeyPatch) -> None:
    package("av")
    monkeypatch.setattr(shared_encodings, "MIN_KEY_PERIOD", 0.0)


@pytest.mark.parametrize("place", KINDS)
async def test_a_film_shows_each_picture_at_once_and_lets_the_camera_rest_afterwards(
    tmp_path: Path, place: str
) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        async with playing(web, place) as player:
            await robot.until(True)
            for number in range(1, 5):
                shoot(serves, numbered(number))
                pictures = await player.until(number)
            assert [each.number for each in pictures] == [1, 2, 3, 4]
            assert pictures[0].at == 0.0
            assert player.media_type == f"video/{place[6:].partition('?')[0]}"
        await robot.until(False)


async def test_all_who_look_at_one_film_see_the_same_from_when_they_came(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        async with playing(web, "front.mp4?width=80&quality=30&rate=60") as first:
            await robot.until(True)
            shoot(serves, numbered(1))
            await first.until(1)
            async with playing(web, "front.mp4?width=80&quality=30&rate=60") as second:
                await until_looking(serves, 2)
                assert films(serves).count == 1
                shoot(serves, numbered(2))
                assert [each.number for each in await first.until(2)] == [1, 2]
                assert await second.until(2) == [Seen(2, 0.0, (80, 60))]
        await robot.until(False)


def films(serves: StationServer) -> shared_encodings.SharedEncodings:
    return serves._http.cameras.films


async def until_looking(serves: StationServer, viewers: int) -> None:
    """So many look at a film and have been let in."""
    async with asyncio.timeout(60):
        while sum(len(film.viewers) for film in films(serves)._films.values()) != viewers:  # noqa: ASYNC110
            await asyncio.sleep(0.001)


@pytest.mark.parametrize(
    ("place", "status", "said"),
    [
        ("stream/front.mp4?codec=av1", 422, "The codec of mp4 must be h264, not 'av1'."),
        ("stream/front.webm?codec=h264", 422, "The codec of webm must be vp8 or vp9, not 'h264'."),
        ("stream/front.mjpeg?codec=h264", 422, "The codec of mjpeg must be jpeg, not 'h264'."),
        ("stream/front.mp4?width=9", 422, "The width must be a whole number from 16 to 4096, not '9'."),
        ("stream/front.webm?rate=inf", 422, "The rate must be a number from 0.1 to 60, not 'inf'."),
        ("snapshot/front.png?quality=50", 422, "A png picture loses nothing and has no quality."),
        ("stream/front.avi", 404, "A camera has no .avi here; there is: mjpeg, mp4, webm."),
        ("stream/front.jpg", 404, "A camera has no .jpg here; there is: mjpeg, mp4, webm."),
        ("snapshot/front.gif", 404, "A camera has no .gif here; there is: jpg, png."),
        ("stream/rear.mp4", 404, "This robot has no such camera; there is: front."),
        ("snapshot/rear.png", 404, "This robot has no such camera; there is: front."),
    ],
)
async def test_what_there_is_not_is_one_sentence_and_leaves_the_camera_at_rest(
    tmp_path: Path, place: str, status: int, said: str
) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        answer = await web.get(f"/{place}")
        assert (answer.status_code, answer.text) == (status, f"{said}\n")
        assert robot.wanted == {}
        assert films(serves).count == 0


async def test_who_asks_only_for_the_head_begins_no_film(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        head = await web.head("/stream/front.mp4")
        assert (head.status_code, head.content, head.headers["content-type"]) == (200, b"", "video/mp4")
        assert (robot.wanted, films(serves).count) == ({}, 0)


async def test_without_the_library_film_is_not_there_and_all_else_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    async with filming(tmp_path) as (robot, serves, web):
        answer = await web.get("/stream/front.webm")
        assert (answer.status_code, answer.text.count("\n")) == (501, 1)
        assert "make video brings it" in answer.text
        for told in ((await web.get("/")).text, (await web.get("/usage.txt")).text):
            assert "make video brings mp4, webm and WebRTC" in told
            assert "/stream/front.mjpeg" in told
            for gone in (".mp4", ".webm", "/whep/", "codec="):
                assert gone not in told
        asked = asyncio.create_task(web.get("/snapshot/front.png?width=100"))
        await robot.until(True)
        shoot(serves, PHOTO)
        picture = Image.open(io.BytesIO((await asked).content))
        assert (picture.format, picture.size) == ("PNG", (100, 75))
        await robot.until(False)


async def test_there_are_only_so_many_viewers_and_films(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(streams, "MAX_VIEWERS", 2)
    monkeypatch.setattr(shared_encodings, "MAX_ENCODINGS", 1)
    async with filming(tmp_path) as (robot, serves, web):
        async with playing(web, "front.mp4"):
            await until_looking(serves, 1)
            other = await web.get("/stream/front.webm")
            assert (other.status_code, other.headers["retry-after"]) == (503, "5")
            assert other.text.startswith("1 films that differ in camera")
            async with playing(web, "front.mp4"):
                await until_looking(serves, 2)
                third = await web.get("/stream/front.mp4")
                said = "2 look at the camera already; close one of them.\n"
                assert (third.status_code, third.text) == (503, said)
        await robot.until(False)


@pytest.mark.parametrize("kind", ["mp4", "webm"])
async def test_a_viewer_who_does_not_read_is_cut_off_and_the_camera_rests(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    monkeypatch.setattr(visit, "STUCK_TIMEOUT", 0.2)
    monkeypatch.setattr(shared_encodings, "KEY_PERIOD", 0.0)  # complete pictures only, which are large
    async with filming(tmp_path) as (robot, serves, _):
        lazy = socket.socket()
        lazy.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        lazy.connect(("127.0.0.1", serves.addresses.http_port))
        lazy.sendall(f"GET /stream/front.{kind}?quality=95 HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode())
        await robot.until(True)

        async def film() -> None:
            while True:
                shoot(serves, PHOTO)
                await asyncio.sleep(0.01)

        filmed = asyncio.create_task(film())
        await robot.until(False)
        filmed.cancel()
        await asyncio.gather(filmed, return_exceptions=True)
        lazy.close()


@pytest.mark.parametrize("place", ["front.mjpeg", *KINDS])
async def test_who_may_not_look_any_more_sees_no_further_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    def refuse(*_: object) -> None:
        raise Refused("The invitation has ended.")

    async with filming(tmp_path) as (robot, serves, web):
        async with playing(web, place) as player:
            await robot.until(True)
            shoot(serves, numbered(1))
            while len(player.film) < 200:
                await player.read()
            shown = player.film
            monkeypatch.setattr(serves.door, "check", refuse)
            shoot(serves, numbered(2))
            with pytest.raises(StopAsyncIteration):
                await player.read()
            assert player.film == shown
        await robot.until(False)


async def test_an_encoder_that_fails_ends_the_film_properly_and_the_site_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> list[Any]:
        raise MemoryError("no room for a picture")

    async with filming(tmp_path) as (robot, serves, web):
        with monkeypatch.context() as broken:
            async with playing(web, "front.mp4") as player:
                await robot.until(True)
                shoot(serves, numbered(1))
                await player.until(1)
                broken.setattr(VideoEncoder, "encode", fail)
                shoot(serves, numbered(2))
                with pytest.raises(StopAsyncIteration):
                    await player.read()
        await robot.until(False)
        async with playing(web, "front.mp4") as player:
            await robot.until(True)
            shoot(serves, numbered(3))
            await player.until(3)


async def test_the_end_of_the_robot_side_ends_films_and_their_thread_too(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        async with playing(web, "front.mp4") as player:
            await robot.until(True)
            shoot(serves, numbered(1))
            await player.until(1)
            serves.end()
            with pytest.raises(httpx.RemoteProtocolError):
                await player.until(9)
        await robot.until(False)
    assert not [each for each in threading.enumerate() if each.name.startswith("film")]


async def test_the_page_says_how_late_each_kind_of_stream_is_once_somebody_has_looked(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        before = (await web.get("/")).text
        assert before.count("delay: measured once somebody looks") == 4
        async with playing(web, "front.mp4") as player:
            await robot.until(True)
            shoot(serves, numbered(1))
            await player.until(1)
        after, text = (await web.get("/")).text, (await web.get("/usage.txt")).text
        assert after.count("delay: measured once somebody looks") == 3
        assert '<a href="/stream/front.mp4">mp4</a> (delay: half of the pictures up to' in after
        assert f"{web.base_url}".rstrip("/") + "/stream/front.mp4 (delay: half of the pictures up to" in text
        assert text.count("delay: measured once somebody looks") == 3
        assert "/whep/front (delay" in text
        assert "make video" not in after + text


def test_a_delay_is_told_in_milliseconds() -> None:
    delays = Delays()
    for age in (0.004, 0.005, 0.090):
        delays.note("/camera", "mp4", age)
    said = "delay: half of the pictures up to 5 ms, 99 of 100 up to 90 ms"
    assert delay_words(delays, "/camera", "mp4") == said
