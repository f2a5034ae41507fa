"""Asking at saved addresses: they are found where no HELLO comes, and lost when they fall silent."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from app.discovery import roll_calls
from app.discovery.known_robots import SILENCE_LIMIT, Entry, KnownRobots
from app.discovery.roll_calls import ASK_PERIOD, FOUND_TIME, HEARD_TIME, MAX_AT_ONCE, MAX_FOUND, RollCalls
from bridge.discovery.hello import Hello
from bridge.discovery.roll import PATH, write_roll
from bridge.server.server import BridgeServer
from robotside.door.door import Door
from robotside.trust.certificate import own_certificate

PATROL = Hello(name="Patrol-1", url="ws://192.0.2.9:9090", http="http://192.0.2.9:8080")


class Asked:
    """Roll calls with a clock of their own, and what they heard."""

    def __init__(self, *saved: str) -> None:
        self.now = 100.0
        self.heard: list[tuple[str, str]] = []
        self.calls = RollCalls(lambda hello, _: self.heard.append((hello.name, hello.url)), lambda: self.now)
        self.calls.wants(Entry(url, "", saved=True) for url in saved)


def test_each_saved_address_is_asked_once_a_second_and_no_other():
    asked = Asked("ws://10.0.0.3:9090")
    asked.calls.wants([Entry("ws://10.0.0.3:9090", "", saved=True), Entry("ws://10.0.0.4:9090", "Stranger")])
    assert asked.calls.due() == ["ws://10.0.0.3:9090"]
    asked.now += ASK_PERIOD - 0.01
    assert asked.calls.due() == []
    asked.now += 0.01
    assert asked.calls.due() == ["ws://10.0.0.3:9090"]


def test_a_robot_that_says_hello_by_itself_is_not_asked():
    asked = Asked("ws://10.0.0.3:9090")
    asked.calls.note("ws://10.0.0.3:9090")
    assert asked.calls.due() == []
    asked.now += HEARD_TIME
    assert asked.calls.due() == ["ws://10.0.0.3:9090"]


def test_an_address_that_was_announced_is_asked_until_it_has_not_answered_for_a_minute():
    asked = Asked()
    asked.calls.add("ws://10.0.0.5:9090")
    assert asked.calls.due() == ["ws://10.0.0.5:9090"]
    asked.now += FOUND_TIME
    assert asked.calls.due() == []


def test_of_announced_addresses_no_more_are_asked_than_there_is_room_for():
    asked = Asked()
    for number in range(2 * MAX_FOUND):
        asked.calls.add(f"ws://10.0.0.{number}:9090")
    seen: set[str] = set()
    for _ in range(20):
        seen.update(asked.calls.due())
        asked.now += ASK_PERIOD
    assert len(seen) == MAX_FOUND


def test_of_many_addresses_a_few_are_asked_at_a_time_and_all_have_their_turn():
    asked = Asked(*(f"ws://10.0.0.{number}:9090" for number in range(3 * MAX_AT_ONCE)))
    seen: list[str] = []
    for _ in range(3):
        chosen = asked.calls.due()
        assert len(chosen) == MAX_AT_ONCE
        seen += chosen
        asked.now += 0.25
    assert len(set(seen)) == 3 * MAX_AT_ONCE


@asynccontextmanager
async def robot(tls_from: Path | None = None) -> AsyncIterator[int]:
    """A robot side with two robots; its port. With a directory it speaks by TLS alone."""
    second = Hello(name="Scout-1", url="ws://192.0.2.9:9091")
    here: list[Hello] = []
    server = BridgeServer(Door(), documents={PATH: lambda: write_roll(here)})
    context = own_certificate(tls_from).context() if tls_from else None
    await server.start(port=0, tls=context, plain_from=lambda _: tls_from is None)
    here += [Hello(name="Patrol-1", url=f"ws://192.0.2.9:{server.port}"), second]
    try:
        yield server.port
    finally:
        await server.close()


@asynccontextmanager
async def stranger(answer: Callable[[asyncio.StreamWriter], Awaitable[None]]) -> AsyncIterator[int]:
    """Something else that listens, and what it answers; its port."""

    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            await reader.readuntil(b"\r\n\r\n")
            await answer(writer)
        except (OSError, asyncio.IncompleteReadError):
            pass
        finally:
            writer.transport.abort()

    server = await asyncio.start_server(serve, "127.0.0.1", 0)
    async with server:
        yield server.sockets[0].getsockname()[1]


async def test_all_robots_of_the_robot_side_at_a_saved_address_are_there():
    async with robot() as port:
        url = f"ws://localhost:{port}"
        asked = Asked(url)
        await asked.calls._ask(url)
        assert asked.heard == [("Patrol-1", url), ("Scout-1", "ws://localhost:9091")]


async def test_a_robot_of_another_domain_is_there_at_a_saved_address_only():
    elsewhere = Hello(name="Patrol-1", url="ws://192.0.2.9:9090", domain="team-2")
    here: list[Hello] = []
    server = BridgeServer(Door(), documents={PATH: lambda: write_roll(here)})
    await server.start(port=0)
    url = f"ws://127.0.0.1:{server.port}"
    here += [Hello(name="Patrol-1", url=url, domain="team-2"), elsewhere]
    try:
        found, saved = Asked(), Asked(url)
        found.calls.add(url)
        await found.calls._ask(url)
        await saved.calls._ask(url)
    finally:
        await server.close()
    assert found.heard == []
    assert [name for name, _ in saved.heard] == ["Patrol-1", "Patrol-1"]


async def test_a_robot_that_speaks_by_tls_alone_is_asked_by_tls_next_time(tmp_path):
    async with robot(tmp_path) as port:
        url = f"ws://127.0.0.1:{port}"
        asked = Asked(url)
        await asked.calls._ask(url)
        assert asked.heard == []
        await asked.calls._ask(url)
        assert asked.heard[0] == ("Patrol-1", url)


async def test_nothing_is_heard_where_nobody_listens():
    async with stranger(lambda _: asyncio.sleep(0)) as port:
        pass
    asked = Asked(f"ws://127.0.0.1:{port}")
    await asked.calls._ask(f"ws://127.0.0.1:{port}")
    assert asked.heard == []


@pytest.mark.parametrize(
    "said",
    [
        b"",
        b"nonsense",
        b"HTTP/1.1 404 Not Found\r\n\r\n" + write_roll([PATROL]),
        b"HTTP/1.1 200 OK\r\n\r\n{}",
        b"HTTP/1.1 426 Upgrade Required\r\n\r\n",
        b"HTTP/1.1 200 OK\r\n\r\n[" + b" " * 1_000_000,
    ],
)
async def test_what_is_no_answer_is_silence(said):
    async def answer(writer: asyncio.StreamWriter) -> None:
        writer.write(said)
        await writer.drain()

    async with stranger(answer) as port:
        url = f"ws://127.0.0.1:{port}"
        asked = Asked(url)
        await asked.calls._ask(url)
        await asked.calls._ask(url)
        assert asked.heard == []


async def test_one_who_never_answers_is_given_up_and_delays_no_other(monkeypatch):
    monkeypatch.setattr(roll_calls, "ASK_TIMEOUT", 0.05)
    held = asyncio.Event()

    async def answer(writer: asyncio.StreamWriter) -> None:
        writer.write(b"HTTP/1.1 200 OK\r\n")
        await held.wait()

    async with stranger(answer) as port:
        asked = Asked(f"ws://127.0.0.1:{port}")
        await asked.calls._ask(f"ws://127.0.0.1:{port}")
        held.set()
    assert asked.heard == []


async def test_asking_ends_with_its_task():
    async with robot() as port:
        asked = Asked(f"ws://127.0.0.1:{port}")
        running = asyncio.create_task(asked.calls.run())
        async with asyncio.timeout(60):
            while not asked.heard:  # noqa: ASYNC110 - there is no event to wait for
                await asyncio.sleep(0.005)
        running.cancel()
        await asyncio.wait({running})
        assert not asked.calls._asking


def test_a_robot_that_was_killed_is_lost_within_three_seconds():
    """The last answer may have come right before; then it is asked in vain."""
    time = [100.0]
    robots = KnownRobots(lambda: time[0], [{"url": "ws://10.0.0.3:9090", "name": "Patrol-1"}])
    robots.heard(Hello(name="Patrol-1", url="ws://10.0.0.3:9090"), time[0], "10.0.0.3")
    assert robots.entries()[0].state == "live"
    time[0] += 3.0
    assert robots.entries()[0].state == "lost"
    assert SILENCE_LIMIT > 2 * ASK_PERIOD  # one answer that is late is no loss
