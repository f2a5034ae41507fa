"""The camera by WebRTC: aiortc is the viewer, on loopback."""

from __future__ import annotations

import asyncio
import random
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import httpx
import pytest

from bridge.core.errors import Refused
from robotside.gateways.http import whep
from robotside.gateways.http.whep import MAX_OFFER
from robotside.gateways.video import newest_picture, shared_encodings
from robotside.serving.station_server import StationServer
from tests.lacking import package
from tests.robotside.gateways.http.test_camera_streams import Filming, filming, shoot
from tests.robotside.gateways.video.scenes import numbered

SDP = {"Content-Type": "application/sdp"}


@pytest.fixture(autouse=True)
def _on_loopback(monkeypatch: pytest.MonkeyPatch) -> None:
    package("aiortc")
    ice = package("aioice.ice")
    monkeypatch.setattr(ice, "get_host_addresses", lambda **_: ["127.0.0.1"])
    monkeypatch.setattr(shared_encodings, "MIN_KEY_PERIOD", 0.0)


class Viewer:
    """A peer that receives one video."""

    def __init__(self) -> None:
        aiortc = package("aiortc")
        self._aiortc: Any = aiortc
        self.peer = aiortc.RTCPeerConnection(aiortc.RTCConfiguration(iceServers=[]))
        self.peer.addTransceiver("video", direction="recvonly")
        self.place = ""

    async def offer(self) -> str:
        await self.peer.setLocalDescription(await self.peer.createOffer())
        sdp: str = self.peer.localDescription.sdp
        return sdp

    async def connect(self, web: httpx.AsyncClient, query: str = "") -> None:
        answer = await web.post(f"/whep/front{query}", content=await self.offer(), headers=SDP)
        assert (answer.status_code, answer.headers["content-type"]) == (201, "application/sdp"), answer.text
        self.place = answer.headers["location"]
        await self.peer.setRemoteDescription(self._aiortc.RTCSessionDescription(answer.text, "answer"))

    async def sees(self, number: int, serves: StationServer) -> tuple[int, int]:
        """Have that picture taken until it is seen; its size."""
        track = self.peer.getReceivers()[0].track
        async with asyncio.timeout(60):
            filmed = asyncio.create_task(_film(number, serves))
            try:
                while True:
                    frame = await track.recv()
                    if round(frame.to_ndarray(format="gray").mean() / 17) == number:
                        return frame.width, frame.height
            finally:
                filmed.cancel()
                await asyncio.gather(filmed, return_exceptions=True)


async def _film(number: int, serves: StationServer) -> None:
    while True:
        shoot(serves, numbered(number))
        await asyncio.sleep(0.03)


@asynccontextmanager
async def viewer() -> AsyncIterator[Viewer]:
    made = Viewer()
    try:
        yield made
    finally:
        await made.peer.close()


async def until_nobody(serves: StationServer, robot: Filming) -> None:
    async with asyncio.timeout(60):
        while serves._http.cameras.whep.count:  # noqa: ASYNC110
            await asyncio.sleep(0.01)
    await robot.until(False)
    assert not [each for each in serves.door._operators if each.way == "http"]


@pytest.mark.parametrize("codec", ["h264", "vp8"])
async def test_a_viewer_sees_the_camera_until_it_says_good_bye(tmp_path: Path, codec: str) -> None:
    async with filming(tmp_path) as (robot, serves, web), viewer() as one:
        await one.connect(web, f"?codec={codec}&width=80")
        assert await one.sees(3, serves) == (80, 60)
        assert await one.sees(9, serves) == (80, 60)
        assert serves._http.cameras.delays.of("/camera/image/compressed", "whep") is not None
        assert (await web.delete(one.place)).status_code == 200
        await until_nobody(serves, robot)
        assert (await web.delete(one.place)).status_code == 404


async def test_two_viewers_and_a_stream_share_one_encoding(tmp_path: Path) -> None:
    async with filming(tmp_path) as (_, serves, web), viewer() as one, viewer() as two:
        await one.connect(web)
        await one.sees(3, serves)
        await two.connect(web)
        async with web.stream("GET", "/stream/front.mp4"):
            await two.sees(5, serves)
            assert serves._http.cameras.films.count == 1


async def test_a_viewer_that_lost_something_gets_a_complete_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wishes: list[object] = []
    async with filming(tmp_path) as (_, serves, web), viewer() as one:
        await one.connect(web)
        await one.sees(3, serves)
        monkeypatch.setattr(shared_encodings._Film, "want_key", lambda film: wishes.append(film))  # noqa: PLW0108
        [receiver] = one.peer.getReceivers()
        [source] = receiver.getSynchronizationSources()
        await receiver._send_rtcp_pli(source.source)
        await one.sees(5, serves)
    assert wishes


async def test_a_viewer_that_is_gone_is_forgotten(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        async with viewer() as one:
            await one.connect(web)
            await one.sees(3, serves)
        await until_nobody(serves, robot)


async def test_who_never_connects_is_forgotten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(whep, "CONNECT_TIMEOUT", 0.05)
    async with filming(tmp_path) as (robot, serves, web), viewer() as one:
        answer = await web.post("/whep/front", content=await one.offer(), headers=SDP)
        assert answer.status_code == 201
        await until_nobody(serves, robot)
        assert robot.wanted == {}


async def test_who_may_not_look_any_more_sees_nothing_more(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise Refused("The invitation has ended.")

    monkeypatch.setattr(newest_picture, "PICTURE_TIMEOUT", 3600.0)  # else the film ends of itself
    async with filming(tmp_path) as (robot, serves, web), viewer() as one:
        await one.connect(web)
        await one.sees(3, serves)
        monkeypatch.setattr(serves.door, "check", refuse)
        shoot(serves, numbered(9))
        await until_nobody(serves, robot)


async def test_who_is_expelled_is_cut_off_at_once(tmp_path: Path) -> None:
    async with filming(tmp_path) as (robot, serves, web), viewer() as one:
        await one.connect(web)
        await one.sees(3, serves)
        [operator] = [each for each in serves.door._operators if each.way == "http"]
        operator.on_expelled()
        await until_nobody(serves, robot)


async def test_the_end_of_the_robot_side_ends_it(tmp_path: Path) -> None:
    async with viewer() as one, filming(tmp_path) as (_, serves, web):
        await one.connect(web)
        await one.sees(3, serves)
    assert serves._http.cameras.whep.count == 0


@pytest.mark.parametrize(
    ("body", "kind", "status", "said"),
    [
        (b"v=0", "text/plain", 415, "An offer is application/sdp."),
        (b"", "application/sdp", 400, "An offer has one video that it wants to receive, not 0."),
        (b"v=0\r\nm=video 9 nonsense\r\n", "application/sdp", 400, "The offer cannot be answered: "),
        (
            b"v=0\r\no=- 0 0 IN IP4 0.0.0.0\r\ns=-\r\nt=0 0\r\n",
            "application/sdp",
            400,
            "An offer has one video",
        ),
        (b"\xff", "application/sdp", 400, "An offer is UTF-8."),
        (b"v" * (MAX_OFFER + 1), "application/sdp", 413, f"An offer has at most {MAX_OFFER} bytes."),
    ],
)
async def test_an_offer_that_is_none_is_one_sentence(
    tmp_path: Path, body: bytes, kind: str, status: int, said: str
) -> None:
    async with filming(tmp_path) as (robot, serves, web):
        answer = await web.post("/whep/front", content=body, headers={"Content-Type": kind})
        assert answer.status_code == status, answer.text
        assert answer.text.startswith(said)
        assert answer.text.count("\n") == 1
        assert robot.wanted == {}
        await until_nobody(serves, robot)


async def test_what_cannot_be_asked_for_is_one_sentence(tmp_path: Path) -> None:
    async with filming(tmp_path) as (_, __, web):
        for place, status in (("rear", 404), ("front?codec=vp9", 422), ("front?width=1", 422)):
            assert (await web.post(f"/whep/{place}", content=b"v=0", headers=SDP)).status_code == status
        assert (await web.get("/whep/front")).status_code == 405


async def test_there_are_only_so_many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(whep, "MAX_SESSIONS", 1)
    async with filming(tmp_path) as (_, serves, web), viewer() as one, viewer() as two:
        await one.connect(web)
        await one.sees(3, serves)  # closed while it connects, the library leaves a task behind
        answer = await web.post("/whep/front", content=await two.offer(), headers=SDP)
        said = "1 look at the camera by WebRTC already; close one of them.\n"
        assert (answer.status_code, answer.text) == (503, said)


async def test_without_the_library_one_sentence_says_what_brings_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "aiortc", None)
    async with filming(tmp_path) as (_, __, web):
        answer = await web.post("/whep/front", content=b"v=0", headers=SDP)
        assert (answer.status_code, answer.text.count("\n")) == (501, 1)
        assert "make video" in answer.text


async def test_the_robot_knocks_at_nobody_but_the_asker(tmp_path: Path) -> None:
    offer = "v=0\r\na=candidate:1 1 udp 9 203.0.113.9 5000 typ host\r\na=candidate:2 1 tcp 9 203.0.113.9 9 typ host\r\n"
    asked = whep._from("127.0.0.1", offer)
    assert asked == "v=0\r\na=candidate:1 1 udp 9 127.0.0.1 5000 typ host\r\n"
    assert whep._from("127.0.0.1", "v=0\r\n").endswith("a=candidate:1 1 udp 1 127.0.0.1 9 typ host\r\n")


async def test_broken_offers_are_refused_or_forgotten_and_leave_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(whep, "CONNECT_TIMEOUT", 0.05)
    rng = random.Random(1)
    async with filming(tmp_path) as (robot, serves, web), viewer() as one:
        lines = (await one.offer()).splitlines()
        for _ in range(12):
            broken = [line for line in lines if rng.random() < 0.9]
            at = rng.randrange(len(broken))
            broken[at] = broken[at][: rng.randrange(len(broken[at]) + 1)]
            answer = await web.post("/whep/front", content="\r\n".join(broken), headers=SDP)
            assert answer.status_code in {201, 400, 503}
            assert answer.status_code == 201 or answer.text.count("\n") == 1
        await until_nobody(serves, robot)
