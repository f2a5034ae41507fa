"""Topics as server-sent events: the newest at a rate, each event once, for as long as it is read and may be read."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from bridge.core.identity import Identity, Role
from robotside.gateways.rest import topic_stream
from tests.fakes import FakeRobot
from tests.robotside.gateways.http.test_doorkeeper import Gate
from tests.robotside.gateways.rest.served import Served, serving
from tests.robotside.scene import Scene


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(1.0)
    return made


@pytest.fixture
async def served(scene: Scene) -> AsyncIterator[Served]:
    async with serving(scene, gate=Gate()) as served:
        yield served


class Reader:
    """Who reads a stream."""

    def __init__(self, answer: httpx.Response) -> None:
        self.answer = answer
        self._lines = answer.aiter_lines()

    async def line(self) -> str:
        async with asyncio.timeout(60):
            async for line in self._lines:
                if line:
                    return line
        return ""

    async def next(self) -> dict[str, Any]:
        line = await self.line()
        assert line.startswith("data: "), line
        found: dict[str, Any] = json.loads(line[6:])
        return found


@contextlib.asynccontextmanager
async def reading(served: Served, path: str, **headers: str) -> AsyncIterator[Reader]:
    async with served.client("w.key", **headers) as web, web.stream("GET", path) as answer:
        assert answer.status_code == 200
        assert answer.headers["content-type"].startswith("text/event-stream")
        yield Reader(answer)


async def ended(served: Served) -> None:
    async with asyncio.timeout(60):
        while served.door._subscriptions or len(served.rest._streams):  # noqa: ASYNC110 - nothing says when
            await asyncio.sleep(0.01)


async def test_the_last_state_comes_at_once_and_each_event_once(served: Served) -> None:
    async with reading(served, "topics/control/status/stream") as reader:
        assert (await reader.next())["driver"] == ""
    async with reading(served, "topics/events", Accept="text/event-stream") as reader:
        for text in ("one", "two", "three"):
            served.scene.station.events.say("control", text)
        assert [(await reader.next())["text"] for _ in range(3)] == ["one", "two", "three"]
    await ended(served)


async def test_of_what_flows_the_newest_comes(served: Served) -> None:
    async with reading(served, "topics/odom/stream?rate=50") as reader:
        served.scene.run(1.0)
        stamp = served.scene.now
        first = await reader.next()
        assert first["header"]["stamp"]["secs"] + first["header"]["stamp"]["nsecs"] / 1e9 == pytest.approx(
            stamp, abs=0.1
        )


async def test_something_comes_while_the_robot_says_nothing(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(topic_stream, "ALIVE_PERIOD", 0.01)
    async with reading(served, "topics/events/stream") as reader:
        assert await reader.line() == ": alive"


async def test_who_may_not_read_it_any_more_reads_no_more(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with reading(served, "topics/events/stream") as reader:
        served.door.expel({"w"})
        assert await reader.line() == ""
    await ended(served)
    ending = Identity("w", "Person w", Role.WATCH, proven=True, ends=served.scene.clock + 1.0)
    monkeypatch.setattr(Gate, "identify", lambda *_: ending)
    async with reading(served, "topics/events/stream") as reader:
        served.scene.clock += 2.0
        served.scene.station.events.say("control", "secret")
        assert await reader.line() == ""
    await ended(served)


async def test_there_are_only_so_many_streams_and_a_stranger_has_none(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(topic_stream, "MAX_STREAMS", 1)
    async with served.client("w.key") as web, served.client() as stranger:
        async with reading(served, "topics/events/stream"):
            answer = await web.get("topics/events/stream")
            assert (answer.status_code, answer.json()["code"]) == (503, "gateway_full")
            assert (await stranger.get("topics/events/stream")).status_code == 401
        await ended(served)
        assert (await web.get("topics/events/stream", headers={"Accept": "text/plain"})).status_code == 406
        async with reading(served, "topics/events/stream"):
            pass


async def test_a_topic_is_made_only_while_it_is_read(served: Served) -> None:
    async with reading(served, "topics/rosout/stream") as reader:
        served.scene.station.events.say("control", "Hello.")
        assert (await reader.next())["msg"] == "Hello."
    await ended(served)
