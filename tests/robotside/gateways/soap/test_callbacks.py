"""Callbacks: only to the client's own address, bounded, tried a few times, and given up."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager

import pytest
from lxml import etree

from bridge.core.errors import BridgeError, Refused
from bridge.core.identity import STRANGER
from bridge.core.robot_catalogue import Operator
from bridge.msgs.pilothouse_msgs import Event, TagRead
from robotside.gateways.soap import callbacks
from robotside.gateways.soap.callbacks import MAX_TRIES, Target, post, target_of
from robotside.gateways.soap.fields import NS
from robotside.gateways.soap.operations import subscriber_contract
from tests.looped import looped
from tests.robotside.gateways.soap.served import Served, body, message, serving
from tests.robotside.scene import Scene


def from_(host: str) -> Operator:
    return Operator("1", f"{host}:5000", 0.0)


@looped(
    ("host", "url", "address", "port"),
    [
        ("192.0.2.7", "http://192.0.2.7:8000/notify?x=1", "192.0.2.7", 8000),
        ("192.0.2.7", "https://192.0.2.7/", "192.0.2.7", 443),
        ("::ffff:192.0.2.7", "http://192.0.2.7", "192.0.2.7", 80),
        ("127.0.0.1", "http://localhost:9/", "127.0.0.1", 9),
        ("[::1]", "http://localhost:9/", "::1", 9),
        ("2001:db8::7", "http://[2001:db8::7]:9/", "2001:db8::7", 9),
    ],
)
def test_a_callback_goes_to_who_asked(host: str, url: str, address: str, port: int) -> None:
    target = target_of(url, from_(host))
    assert (target.address, target.port) == (address, port)


@looped(
    "url",
    [
        "http://127.0.0.1/",
        "http://localhost/",
        "http://[::1]/",
        "http://[::ffff:127.0.0.1]/",
        "http://0.0.0.0/",
        "http://2130706433/",
        "http://0x7f.1/",
        "http://0300.0.2.7/",
        "http://169.254.169.254/latest/meta-data",
        "http://192.0.2.8/",
        "http://192.0.2.7.evil.example/",
        "http://evil.example/",
        "http://192.0.2.7@127.0.0.1/",
        "http://127.0.0.1#@192.0.2.7/",
        "http://user:secret@192.0.2.7/",
        "http://192.0.2.7:99999/",
        "http://192.0.2.7/a b",
        "http://192.0.2.7/\r\nHost: evil",
        "http://192.0.2.7/\u212a",
        "ftp://192.0.2.7/",
        "file:///etc/passwd",
        "//192.0.2.7/",
        "192.0.2.7",
        "http://",
        "",
        "http://[::1",
    ],
)
def test_to_nobody_else(url: str) -> None:
    with pytest.raises(Refused, match="callback") as problem:
        target_of(url, from_("192.0.2.7"))
    assert "secret" not in str(problem.value)


def test_not_to_a_name_for_who_has_no_address() -> None:
    with pytest.raises(Refused, match="not known"):
        target_of("http://unknown/", from_("unknown"))


class Client:
    """A web server that takes callbacks, and answers them as it is told."""

    def __init__(self) -> None:
        self.answers = [b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n"]
        """The last one goes on for ever."""
        self.heard: list[bytes] = []
        self.port = 0
        self._changed = asyncio.Event()

    async def take(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        head = await reader.readuntil(b"\r\n\r\n")
        length = int(head.lower().partition(b"content-length:")[2].partition(b"\r\n")[0])
        self.heard.append(head + await reader.readexactly(length))
        answer = self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]
        self._changed.set()
        if answer:
            writer.write(answer)
            await writer.drain()
            writer.close()
        else:
            await reader.read()
            writer.close()

    async def until(self, so: Callable[[], object]) -> None:
        async with asyncio.timeout(60):
            while not so():
                self._changed.clear()
                await self._changed.wait()


@asynccontextmanager
async def listening() -> AsyncIterator[Client]:
    client = Client()
    server = await asyncio.start_server(client.take, "127.0.0.1", 0)
    client.port = server.sockets[0].getsockname()[1]
    try:
        yield client
    finally:
        server.close()
        await server.wait_closed()


def target(client: Client) -> Target:
    return Target("127.0.0.1", client.port, f"127.0.0.1:{client.port}", "/notify", secure=False)


BROKEN = {
    "a redirection": b"HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:1/\r\n\r\n",
    "a fault": b"HTTP/1.1 500 Oh\r\n\r\n",
    "no HTTP": b"hello\r\n\r\n",
    "nothing": b"HTTP/1.1",
    "endless headers": b"HTTP/1.1 200 OK\r\n" + b"X: y\r\n" * 100_000,
}


@pytest.mark.parametrize("answer", BROKEN.values(), ids=BROKEN)
async def test_what_is_no_success_is_none(answer: bytes) -> None:
    async with listening() as client:
        client.answers = [answer]
        with pytest.raises(BridgeError, match="callback"):
            await post(target(client), b"<x/>", "a")
        assert len(client.heard) == 1


async def test_one_that_does_not_answer_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(callbacks, "POST_TIMEOUT", 0.05)
    async with listening() as client:
        client.answers = [b""]
        with pytest.raises(BridgeError, match="no answer in time"):
            await post(target(client), b"<x/>", "a")
    with pytest.raises(BridgeError, match="not taken"):
        await post(target(client), b"<x/>", "a")


async def subscribed(served: Served, client: Client, *topics: str) -> str:
    url = f"http://localhost:{client.port}/notify"
    asked = message(body("Subscribe", topic=list(topics), callback=url))
    answer = await served.post(asked, host="127.0.0.1")
    return answer.value("subscription") or ""


async def test_messages_come_as_the_contract_says_until_it_ends(scene: Scene) -> None:
    judge = subscriber_contract().judge()
    async with serving(scene, "soap=?rate=50") as served, listening() as client:
        id = await subscribed(served, client, "/control/status", "/tag")
        await client.until(lambda: client.heard)
        head, _, raw = client.heard[0].partition(b"\r\n\r\n")
        assert head.startswith(b"POST /notify HTTP/1.1")
        assert f'SOAPAction: "{NS}#Notify"'.encode() in head
        notify = etree.fromstring(raw)[0][0]
        assert judge.validate(etree.fromstring(etree.tostring(notify))), judge.error_log
        assert notify.findtext(f"{{{NS}}}subscription") == id
        scene.station.bus.publish("/tag", TagRead(tag="card-12"))
        await client.until(lambda: any(b"card-12" in each for each in client.heard))
        assert (await served.ask("Unsubscribe", subscription=id)).value("message")
        scene.station.bus.publish("/tag", TagRead(tag="card-13"))
        assert not served.gateway._callbacks._tasks
        assert not served.gateway._subscriptions._open
    assert not any(b"card-13" in each for each in client.heard)


@pytest.fixture
def hasty(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(callbacks, "RETRY_PERIOD", 0.001)


async def over(served: Served) -> None:
    async with asyncio.timeout(60):
        while served.gateway._subscriptions._open:  # noqa: ASYNC110 - what is waited for is no event
            await asyncio.sleep(0.005)


@pytest.mark.usefixtures("hasty")
async def test_one_that_nobody_takes_is_tried_a_few_times_and_then_ended_and_told_of(scene: Scene) -> None:
    async with serving(scene) as served, listening() as client:
        client.answers = [BROKEN["a fault"]]
        await subscribed(served, client, "/control/status")
        await over(served)
        assert len(client.heard) == MAX_TRIES
        assert len(set(client.heard)) == 1
    (said,) = [msg for _, msg in scene.said if isinstance(msg, Event) and msg.code == "gateway_callback_lost"]
    assert "Nobody at 127.0.0.1 takes the callbacks" in said.text
    assert "HTTP status 500" in said.text


@pytest.mark.usefixtures("hasty")
async def test_a_fault_that_passes_loses_nothing(scene: Scene) -> None:
    async with serving(scene) as served, listening() as client:
        client.answers = [BROKEN["a fault"], BROKEN["nothing"], client.answers[0]]
        await subscribed(served, client, "/control/status")
        await client.until(lambda: len(client.heard) == MAX_TRIES)
        await served.ask("Stop")
        await client.until(lambda: len(client.heard) > MAX_TRIES)
        assert len(served.gateway._subscriptions) == 1


@pytest.mark.usefixtures("hasty")
async def test_who_may_not_read_any_more_is_sent_nothing(scene: Scene) -> None:
    async with serving(scene) as served, listening() as client:
        id = await subscribed(served, client, "/tag")
        served.gateway._subscriptions._open[id].operator.identity = STRANGER
        scene.station.bus.publish("/tag", TagRead(tag="card-12"))
        await over(served)
        assert not client.heard
