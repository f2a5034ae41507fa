"""Webhooks: events arrive signed, once taken; a receiver that takes none is given up and told of, and nothing is left."""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import json
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from bridge.core.codes import Code
from bridge.core.errors import ProtocolError, Refused
from bridge.core.identity import STRANGER, Identity, Role
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice
from robotside.gateways.webhooks import delivery, hooks
from robotside.gateways.webhooks.hooks import MAX_WAITING, Hooks
from tests.fakes import FakeRobot
from tests.robotside.gateways.http.test_doorkeeper import Gate
from tests.robotside.gateways.rest.served import serving
from tests.robotside.scene import Scene

SECRET = "a-secret-of-sixteen-or-more"


def someone(role: Role = Role.MANAGE, id: str = "m", host: str = "127.0.0.1") -> Operator:
    return Operator("1", f"{host}:50000", 0.0, identity=Identity(id, id, role, proven=bool(id)))


async def until(done: Callable[[], bool]) -> None:
    async with asyncio.timeout(60):
        while not done():  # noqa: ASYNC110 - nothing says when
            await asyncio.sleep(0.005)


class Receiver:
    """A web server that answers with `status`."""

    def __init__(self) -> None:
        self.status = b"200 OK"
        self.got: list[tuple[dict[str, str], bytes]] = []
        self.port = 0

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/hook?k=1"

    @property
    def texts(self) -> list[str]:
        return [json.loads(body)["text"] for _, body in self.got]

    async def answer(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        first, *lines = (await reader.readuntil(b"\r\n\r\n")).decode().split("\r\n")[:-2]
        assert first == "POST /hook?k=1 HTTP/1.1"
        headers = {name.lower(): value for name, value in (line.split(": ", 1) for line in lines)}
        self.got.append((headers, await reader.readexactly(int(headers["content-length"]))))
        writer.write(b"HTTP/1.1 " + self.status + b"\r\nContent-Length: 0\r\n\r\n" if self.status else b"")
        writer.close()


@asynccontextmanager
async def receiving() -> AsyncIterator[Receiver]:
    receiver = Receiver()
    server = await asyncio.start_server(receiver.answer, "127.0.0.1", 0)
    receiver.port = server.sockets[0].getsockname()[1]
    try:
        yield receiver
    finally:
        server.close()


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    return Scene(FakeRobot(), tmp_path)


@pytest.fixture
async def made(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Hooks]:
    monkeypatch.setattr(hooks, "BACKOFFS", (0.0, 0.0))
    made = Hooks(scene.door, scene.station.events.say)
    yield made
    tasks = [hook.task for hook in made._hooks.values() if hook.task]
    await made.close()
    assert all(task.done() for task in tasks)
    assert not scene.door._subscriptions


def say(scene: Scene, text: str, level: str = "info", code: Code = Code.MAP_ARRIVED) -> None:
    scene.station.events.say("control", Notice(code, text), level)


async def test_events_arrive_in_order_and_their_signature_proves_the_robot_and_the_time(
    scene: Scene, made: Hooks
) -> None:
    async with receiving() as receiver:
        told = await made.add(someone(), {"url": receiver.url, "secret": SECRET})
        assert told["secret"] == SECRET
        for text in ("One.", "Two.", "Three."):
            say(scene, text)
        await until(lambda: len(receiver.got) == 3)
        assert receiver.texts == ["One.", "Two.", "Three."]
        headers, body = receiver.got[0]
        proof = hmac.new(SECRET.encode(), headers["pilothouse-time"].encode() + b"." + body, hashlib.sha256)
        assert headers["pilothouse-signature"] == f"sha256={proof.hexdigest()}"
        assert headers["pilothouse-delivery"] == "b1-1"
        assert float(headers["pilothouse-time"]) == pytest.approx(scene.clock, abs=1.0)
        assert headers["content-type"] == "application/json"
        await until(lambda: made.shown(someone())[0]["delivered"] == 3)
        assert "secret" not in made.shown(someone())[0]


async def test_only_what_was_asked_for_is_sent(scene: Scene, made: Hooks) -> None:
    async with receiving() as receiver:
        await made.add(someone(), {"url": receiver.url, "levels": ["alarm"], "codes": ["map_missing"]})
        say(scene, "Wrong level.", "info", Code.MAP_MISSING)
        say(scene, "Wrong code.", "alarm")
        say(scene, "Right.", "alarm", Code.MAP_MISSING)
        await until(lambda: bool(receiver.got))
        assert receiver.texts == ["Right."]


@pytest.mark.parametrize(
    "status", [b"500 Broken", b"302 Elsewhere\r\nLocation: http://127.0.0.1/", b"404 None", b""]
)
async def test_what_is_not_taken_is_tried_again_and_then_given_up_and_told_of_once(
    scene: Scene, made: Hooks, status: bytes
) -> None:
    async with receiving() as receiver:
        receiver.status = status
        await made.add(someone(), {"url": receiver.url})
        for text in ("One.", "Two."):
            say(scene, text)
        await until(lambda: made.shown(someone())[0]["failed"] == 2)
        assert receiver.texts == ["One."] * 3 + ["Two."] * 3
        told = [text for text in scene.events() if "takes no events" in text]
        assert len(told) == 1
        assert "k=1" not in told[0]
        receiver.status = b"204 Taken"
        say(scene, "Three.")
        await until(lambda: made.shown(someone())[0]["problem"] == "")
        receiver.status = b"500 Broken"
        say(scene, "Four.")
        await until(lambda: made.shown(someone())[0]["failed"] == 3)
        assert sum("takes no events" in text for text in scene.events()) == 2


async def test_a_receiver_that_is_gone_or_does_not_answer_is_given_up(
    scene: Scene, made: Hooks, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(delivery, "TIMEOUT", 0.05)
    async with receiving() as receiver:
        gone = receiver.url
    writers: list[asyncio.StreamWriter] = []

    async def listen(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        writers.append(writer)

    silent = await asyncio.start_server(listen, "127.0.0.1", 0)
    port = silent.sockets[0].getsockname()[1]
    await made.add(someone(), {"url": gone})
    await made.add(someone(), {"url": f"http://127.0.0.1:{port}/hook"})
    say(scene, "One.")
    await until(lambda: all(each["failed"] == 1 for each in made.shown(someone())))
    problems = [each["problem"] for each in made.shown(someone())]
    assert "no answer within 0.05 s" in problems[1]
    silent.close()
    for writer in writers:
        writer.close()


async def test_what_waits_is_bounded_and_the_newest_are_kept(scene: Scene, made: Hooks) -> None:
    async with receiving() as receiver:
        await made.add(someone(), {"url": receiver.url})
        for number in range(MAX_WAITING + 10):
            say(scene, f"{number}.")
        await until(lambda: len(receiver.got) == MAX_WAITING)
        assert receiver.texts[-1] == f"{MAX_WAITING + 9}."


async def test_a_name_that_leads_elsewhere_later_is_not_followed(
    scene: Scene, made: Hooks, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with receiving() as receiver:
        url = receiver.url.replace("127.0.0.1", "rebinding.example")

        async def near(*_: object) -> str:
            return "192.0.2.7"

        async def own(*_: object) -> str:
            return "127.0.0.1"

        monkeypatch.setattr(hooks, "look_up", near)
        monkeypatch.setattr(delivery, "look_up", own)
        await made.add(someone(host="192.0.2.7"), {"url": url})
        say(scene, "One.")
        await until(lambda: made.shown(someone())[0]["failed"] == 1)
        assert not receiver.got
        assert "own machine" in made.shown(someone())[0]["problem"]


WRONG: dict[str, Any] = {
    "url": {"url": "file:///etc/passwd"},
    "no url": {},
    "unknown field": {"url": "http://127.0.0.1/", "levls": []},
    "a list": [],
    "a number": {"url": 7},
    "level": {"url": "http://127.0.0.1/", "levels": ["fatal"]},
    "code": {"url": "http://127.0.0.1/", "codes": ["no_such_code"]},
    "short secret": {"url": "http://127.0.0.1/", "secret": "short"},
    "long secret": {"url": "http://127.0.0.1/", "secret": "x" * 129},
}


@pytest.mark.parametrize("how", WRONG)
async def test_a_wrong_wish_is_one_sentence(made: Hooks, how: str) -> None:
    with pytest.raises(ProtocolError, match=r"\.$"):
        await made.add(someone(), WRONG[how])
    assert len(made) == 0


async def test_who_may_not_have_events_sent_is_refused(made: Hooks, monkeypatch: pytest.MonkeyPatch) -> None:
    wish = {"url": "http://127.0.0.1:1/"}
    for role in (Role.NONE, Role.WATCH):
        with pytest.raises(Refused, match="need the role drive"):
            await made.add(someone(role), wish)
        with pytest.raises(Refused, match="need the role drive"):
            made.shown(someone(role))
    with pytest.raises(Refused, match="own machine"):
        await made.add(someone(host="192.0.2.7"), wish)
    with pytest.raises(Refused, match="the address that you ask from"):
        await made.add(someone(Role.DRIVE), {"url": "http://10.1.2.3/"})
    monkeypatch.setattr(hooks, "MAX_HOOKS", 1)
    await made.add(someone(Role.DRIVE, "d"), wish)
    with pytest.raises(Refused, match="remove one"):
        await made.add(someone(), wish)


async def test_one_sees_and_removes_ones_own_and_who_manages_all(made: Hooks) -> None:
    wish = {"url": "http://127.0.0.1:1/"}
    driver, other, manager = someone(Role.DRIVE, "d"), someone(Role.DRIVE, "o"), someone(Role.MANAGE, "m")
    first = (await made.add(driver, wish))["id"]
    second = (await made.add(other, wish))["id"]
    assert [each["id"] for each in made.shown(driver)] == [first]
    assert [each["id"] for each in made.shown(manager)] == [first, second]
    assert not made.remove(other, first)
    assert not made.remove(manager, 99)
    assert made.remove(driver, first)
    assert made.remove(manager, second)
    assert len(made) == 0


async def test_the_webhooks_of_who_may_nothing_any_more_end(scene: Scene, made: Hooks) -> None:
    async with receiving() as receiver:
        await made.add(someone(id="gone"), {"url": receiver.url})
        guest = someone(Role.DRIVE, "guest")
        ends = scene.clock + 10.0
        guest.identity = Identity("guest", "guest", Role.DRIVE, proven=True, ends=ends)
        await made.add(guest, {"url": receiver.url})
        removed = Notice(Code.PERSON_REMOVED, "Gone was removed.", actor_id="gone", name="Gone")
        scene.station.events.say("control", removed)
        await until(lambda: len(receiver.got) == 1)
        assert len(made) == 1
        scene.clock += 11.0
        say(scene, "One.")
        assert len(made) == 0
        assert len(receiver.got) == 1


@pytest.mark.parametrize(
    ("becomes", "said"),
    [
        (STRANGER, "Webhooks need the role drive"),
        (Identity("m", "m", Role.WATCH, proven=True), "Webhooks need the role drive"),
        (Identity("other", "other", Role.MANAGE, proven=True), "somebody else"),
    ],
)
async def test_who_may_less_once_the_host_is_looked_up_makes_none(
    scene: Scene, made: Hooks, monkeypatch: pytest.MonkeyPatch, becomes: Identity, said: str
) -> None:
    operator = someone()

    async def look_up(*_: object) -> str:
        operator.identity = becomes
        return "192.0.2.7"

    monkeypatch.setattr(hooks, "look_up", look_up)
    with pytest.raises(Refused, match=said):
        await made.add(operator, {"url": "http://elsewhere.example/hook"})
    assert not len(made)


async def test_by_rest_they_are_made_read_and_removed_and_end_with_the_gateway(scene: Scene) -> None:
    before = asyncio.all_tasks()
    async with receiving() as receiver, serving(scene, gate=Gate()) as served:
        async with served.client("w.key") as watcher:
            assert (await watcher.post("webhooks", json={"url": receiver.url})).status_code == 403
            assert (await watcher.get("webhooks")).status_code == 403
        async with served.client("m.key") as web:
            answer = await web.post("webhooks", json={"url": receiver.url})
            assert answer.status_code == 201
            assert len(answer.json()["secret"]) >= 32
            assert [each["id"] for each in (await web.get("webhooks")).json()["webhooks"]] == [1]
            assert (await web.post("webhooks", json={"url": "http://169.254.169.254/"})).status_code == 403
            assert (await web.post("webhooks", json={"url": "gopher://x"})).status_code == 422
            xml = {"Content-Type": "application/xml"}
            assert (await web.post("webhooks", content=b"<r/>", headers=xml)).status_code == 415
            say(scene, "One.")
            await until(lambda: receiver.texts == ["One."])
            assert (await web.delete("webhooks/7")).status_code == 404
            assert (await web.delete("webhooks/1")).status_code == 200
            assert (await web.post("webhooks", json={"url": receiver.url})).status_code == 201
    assert asyncio.all_tasks() == before
