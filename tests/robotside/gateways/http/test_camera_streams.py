"""The camera in a browser: real HTTP on loopback, a camera that the test works."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncGenerator, AsyncIterator
from contextlib import aclosing, asynccontextmanager
from pathlib import Path

import httpx
import msgspec
import pytest

from bridge.core.topics import CAMERA
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.gateways.http import browser_connection as visit
from robotside.gateways.http import camera_streams as streams
from robotside.gateways.video import newest_picture
from robotside.serving.station_server import StationServer
from tests.fakes import FakeRobot
from tests.robotside.gateways.scaling.test_picture_scaling import PHOTO, size
from tests.robotside.serving.test_station_server import serving
from tests.robotside.visitor import visitor

STREAM = "/stream/front.mjpeg"


class Filming(FakeRobot):
    """Has a camera; tells the test when it is wanted."""

    def __init__(self) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, cameras=["front"])
        self.changed = asyncio.Event()

    def want(self, topic: str, wanted: bool) -> None:
        super().want(topic, wanted)
        self.changed.set()

    async def until(self, wanted: bool) -> None:
        async with asyncio.timeout(60):
            while self.wanted.get(CAMERA, False) is not wanted:
                self.changed.clear()
                await self.changed.wait()


@asynccontextmanager
async def filming(state: Path) -> AsyncIterator[tuple[Filming, StationServer, httpx.AsyncClient]]:
    robot = Filming()
    async with serving(state, robot) as serves, visitor(serves.addresses.http) as web:
        yield robot, serves, web


def shoot(serves: StationServer, jpeg: bytes) -> None:
    serves.station.bus.publish(CAMERA, CompressedImage(data=jpeg))


class Reader:
    """The parts of a multipart response."""

    def __init__(self, chunks: AsyncGenerator[bytes]) -> None:
        self._chunks = chunks
        self._raw = b""

    async def until(self, end: bytes) -> bytes:
        async with asyncio.timeout(60):
            while end not in self._raw:
                self._raw += await anext(self._chunks)
        found, _, self._raw = self._raw.partition(end)
        return found

    async def picture(self) -> bytes:
        """The next picture, as soon as the boundary behind it is there: what a browser waits for."""
        head = await self.until(b"\r\n\r\n")
        jpeg = await self.until(b"\r\n--picture\r\n")
        assert b"Content-Type: image/jpeg" in head
        assert f"Content-Length: {len(jpeg)}".encode() in head
        return jpeg


@asynccontextmanager
async def looking(web: httpx.AsyncClient, place: str = STREAM) -> AsyncIterator[Reader]:
    """A viewer of a stream that has begun."""
    async with web.stream("GET", place) as answer, aclosing(answer.aiter_bytes()) as chunks:
        assert answer.headers["content-type"] == "multipart/x-mixed-replace; boundary=picture"
        reader = Reader(chunks)
        assert await reader.until(b"--picture\r\n") == b""
        yield reader


async def test_a_stream_shows_each_picture_at_once_and_lets_the_camera_rest_afterwards(
    tmp_path: Path,
) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        shoot(serves, b"taken before anybody looked")
        async with looking(web) as reader:
            await robot.until(True)
            for jpeg in (b"first", b"second"):
                shoot(serves, jpeg)
                assert await reader.picture() == jpeg
        await robot.until(False)


async def test_two_viewers_see_the_same_camera_each_in_its_own_way(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        async with looking(web) as whole, looking(web, f"{STREAM}?width=160&quality=30") as small:
            shoot(serves, PHOTO)
            assert await whole.picture() == PHOTO
            assert size(await small.picture()) == (160, 120)
        await robot.until(False)


async def test_a_rate_leaves_out_what_came_meanwhile(tmp_path: Path) -> None:
    async with filming(tmp_path) as (_, serves, web), looking(web, f"{STREAM}?rate=20") as reader:
        shoot(serves, b"1")
        assert await reader.picture() == b"1"
        for number in range(2, 10):
            shoot(serves, b"%d" % number)
        assert await reader.picture() == b"9"


async def test_a_viewer_who_does_not_read_is_cut_off_and_the_camera_rests(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(visit, "STUCK_TIMEOUT", 0.2)
    async with filming(tmp_path) as (robot, serves, _):
        lazy = socket.socket()
        lazy.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        lazy.connect(("127.0.0.1", serves.addresses.http_port))
        lazy.sendall(f"GET {STREAM} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode())
        await robot.until(True)

        async def film() -> None:
            while True:
                shoot(serves, bytes(50_000))
                await asyncio.sleep(0.01)

        filmed = asyncio.create_task(film())
        await robot.until(False)
        filmed.cancel()
        await asyncio.gather(filmed, return_exceptions=True)
        lazy.close()


async def test_a_stream_that_is_read_outlasts_what_other_visits_may_take(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(visit, "MAX_CONNECTION_TIME", 0.05)
    monkeypatch.setattr(visit, "STUCK_TIMEOUT", 0.05)
    async with filming(tmp_path) as (_, serves, web), looking(web) as reader:
        for number in range(8):
            await asyncio.sleep(0.02)
            shoot(serves, b"%d" % number)
            assert await reader.picture() == b"%d" % number


async def test_a_camera_that_gives_nothing_ends_the_stream(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(newest_picture, "PICTURE_TIMEOUT", 0.05)
    async with filming(tmp_path) as (robot, _, web):
        answer = await web.get(STREAM)
        assert answer.text == "--picture\r\n"
        await robot.until(False)


async def test_there_are_only_so_many_viewers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(streams, "MAX_VIEWERS", 1)
    async with filming(tmp_path) as (robot, _, web):
        async with looking(web):
            refused = await web.get(STREAM)
            said = "1 look at the camera already; close one of them.\n"
            assert (refused.status_code, refused.text) == (503, said)
        await robot.until(False)


async def test_the_end_of_the_robot_side_ends_streams_too(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        async with looking(web) as reader:
            serves.end()
            with pytest.raises(httpx.RemoteProtocolError):
                await reader.until(b"for ever")
        await robot.until(False)


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ("width=0", "The width must be a whole number from 16 to 4096, not '0'."),
        ("width=1e3", "The width must be a whole number from 16 to 4096, not '1e3'."),
        ("quality=100", "The quality must be a whole number from 1 to 95, not '100'."),
        ("quality=", "The quality must be a whole number from 1 to 95, not ''."),
        ("rate=nan", "The rate must be a number from 0.1 to 60, not 'nan'."),
        ("rate=" + "9" * 5000, f"The rate must be a number from 0.1 to 60, not '{'9' * 20}'."),
    ],
)
async def test_a_number_that_cannot_be_is_one_sentence(tmp_path: Path, query: str, said: str) -> None:
    async with filming(tmp_path) as (robot, _, web):
        for place in (STREAM, "/snapshot/front.jpg"):
            answer = await web.get(f"{place}?{query}")
            assert (answer.status_code, answer.text) == (422, f"{said}\n")
        assert robot.wanted == {}


async def test_a_camera_that_is_not_there_is_told_with_those_that_are(tmp_path: Path) -> None:
    async with filming(tmp_path) as (_, __, web):
        for place in ("/stream/rear.mjpeg", "/snapshot/rear.jpg"):
            answer = await web.get(place)
            said = "This robot has no such camera; there is: front.\n"
            assert (answer.status_code, answer.text) == (404, said)


async def test_a_snapshot_may_be_smaller(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        asked = asyncio.create_task(web.get("/snapshot/front.jpg?width=100"))
        await robot.until(True)
        shoot(serves, PHOTO)
        assert size((await asked).content) == (100, 75)
        await robot.until(False)


async def test_snapshots_of_many_sizes_at_once_are_all_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.gateways.http.camera_pages.SNAPSHOT_TIMEOUT", 10.0)
    async with filming(tmp_path) as (robot, serves, web):
        sizes = range(100, 340, 10)
        asked = [asyncio.create_task(web.get(f"/snapshot/front.jpg?width={width}")) for width in sizes]
        await robot.until(True)
        while not all(each.done() for each in asked):
            shoot(serves, PHOTO)
            await asyncio.wait(asked, timeout=0.1)
        assert [size((await each).content)[0] for each in asked] == [*sizes]
        await robot.until(False)


async def test_a_broken_picture_made_smaller_is_one_sentence(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        asked = asyncio.create_task(web.get("/snapshot/front.jpg?width=100"))
        await robot.until(True)
        shoot(serves, b"no picture")
        answer = await asked
        assert answer.status_code == 502
        assert answer.text.startswith("The picture cannot be made smaller: it is no whole JPEG file")


async def test_the_page_shows_the_camera(tmp_path: Path) -> None:
    async with filming(tmp_path) as (_, __, web):
        page = (await web.get("/")).text
        assert '<img src="/stream/front.mjpeg' in page
        assert 'href="/snapshot/front.jpg"' in page
        assert 'href="/stream/front.mp4"' in page


@pytest.mark.parametrize("place", [STREAM, "/snapshot/front.jpg"])
async def test_who_asks_only_for_the_head_or_with_another_word_leaves_the_camera_at_rest(
    tmp_path: Path, place: str
) -> None:
    async with filming(tmp_path) as (robot, _, web):
        head = await web.head(place)
        assert (head.status_code, head.content, head.headers["cache-control"]) == (200, b"", "no-store")
        assert (await web.head(f"{place}?width=1")).status_code == 422
        other = await web.post(place)
        assert (other.status_code, sorted(other.headers["allow"].split(", "))) == (405, ["GET", "HEAD"])
        assert robot.wanted == {}
