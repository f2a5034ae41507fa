"""STOP behind many requests that came before it: it is pressed before more than a few of them begin, whatever the protocol.

Steps of the loop are counted, and no time: each test drives the applications themselves, without sockets.
"""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable, Coroutine, MutableMapping
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from aiocoap import Message
from aiocoap.numbers.codes import Code as CoapCode

from robotside.door.gate import OPEN
from robotside.gateways.coap.datagrams import Endpoint
from tests.fakes import FakeRobot
from tests.robotside.gateways.coap import client as coap_client
from tests.robotside.gateways.rest import served as rest_served
from tests.robotside.gateways.soap import served as soap_served
from tests.robotside.scene import Scene

FLOOD = 60
"""Requests that are there before STOP: as many as the web site has places."""
MAX_STEPS = 3
"""Steps of the loop until STOP is pressed."""
MAX_BEGUN = 4
"""Requests that may begin before it is pressed: one in each step, and one that began at once."""
PAUSE = soap_served.message(soap_served.body("Pause"))
STOP = soap_served.message(soap_served.body("Stop"))


@dataclass
class Flooded:
    """A gateway that is asked."""

    scene: Scene
    ask: Callable[[], Coroutine[Any, Any, object]]
    """Sends an ordinary request."""
    stop: Callable[[], Coroutine[Any, Any, object]]
    """Sends STOP."""
    begun: list[int]
    """A member for each ordinary request that began."""


def counted(owner: object, name: str) -> list[int]:
    """Counts the calls of an owner's method from now on."""
    calls: list[int] = []
    method = getattr(owner, name)

    def call(*args: Any) -> Any:
        calls.append(1)
        return method(*args)

    setattr(owner, name, call)
    return calls


def request(site: Any, path: str, body: bytes, number: int = 0, **headers: str) -> Coroutine[Any, Any, None]:
    """A request to an ASGI application, whose body is there already; its answer is passed over."""
    said = {"host": "127.0.0.1:8080", "content-length": str(len(body)), **headers}
    scope = {
        "type": "http",
        "http_version": "1.1",
        "method": "POST",
        "scheme": "http",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "root_path": "",
        "server": ("127.0.0.1", 8080),
        "client": ("127.0.0.1", 5000 + number),
        "headers": [(name.replace("_", "-").encode(), value.encode()) for name, value in said.items()],
    }

    async def receive() -> MutableMapping[str, Any]:
        return {"type": "http.request", "body": body, "more_body": False}

    async def send(_: MutableMapping[str, Any]) -> None:
        return

    work: Coroutine[Any, Any, None] = site(scope, receive, send)
    return work


@asynccontextmanager
async def by_rest(scene: Scene) -> AsyncIterator[Flooded]:
    async with rest_served.serving(scene, "?role=drive", gate=OPEN) as served:
        site, kind = served.http.site, {"content_type": "application/json"}
        yield Flooded(
            scene,
            lambda: request(site, "/api/services/task/pause", b"{}", **kind),
            lambda: request(site, "/api/stop", b"{}", **kind),
            counted(served.rest, "_app"),
        )


@asynccontextmanager
async def by_soap(scene: Scene, **action: str) -> AsyncIterator[Flooded]:
    async with soap_served.serving(scene, "soap=?role=drive") as served:
        site, kind = served.http.site, {"content_type": soap_served.TYPE}
        yield Flooded(
            scene,
            lambda: request(site, "/soap", PAUSE.encode(), **kind),
            lambda: request(site, "/soap", STOP.encode(), **kind, **action),
            counted(served.gateway, "_do"),
        )


def by_soap_with_action(scene: Scene) -> AbstractAsyncContextManager[Flooded]:
    return by_soap(scene, soapaction=f'"{soap_served.ACTION}Stop"')


@asynccontextmanager
async def by_coap(scene: Scene) -> AsyncIterator[Flooded]:
    async with coap_client.serving(scene) as gateway:
        site = gateway._site
        assert site is not None

        def asks(*path: str) -> Coroutine[Any, Any, None]:
            said = Message(code=CoapCode.POST, uri_path=path, payload=b"{}", content_format=50)
            said.remote = Endpoint("127.0.0.1", 5000, "127.0.0.1:5683", ("127.0.0.1", 5000))
            return site.answer(SimpleNamespace(request=said, add_response=lambda *_, **__: None))

        yield Flooded(scene, lambda: asks("task", "pause"), lambda: asks("stop"), counted(site, "_command"))


WAYS = {
    "rest": by_rest,
    "soap": by_soap_with_action,
    "soap without an action": by_soap,
    "coap": by_coap,
}


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
async def test_stop_is_pressed_before_more_than_a_few_requests_that_came_first(
    way: Callable[[Scene], AbstractAsyncContextManager[Flooded]], tmp_path: Path
) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(1.0)
    async with way(scene) as flooded:
        others = [asyncio.create_task(flooded.ask()) for _ in range(FLOOD)]
        pressing = asyncio.create_task(flooded.stop())
        for _ in range(MAX_STEPS):
            assert len(flooded.begun) <= MAX_BEGUN
            if scene.station.controls.stopped:
                break
            await asyncio.sleep(0)
        assert scene.station.controls.stopped
        assert len(flooded.begun) <= MAX_BEGUN
        while not all(task.done() for task in (*others, pressing)):
            scene.run(0.1)  # whose answers wait until STOP is kept
            await asyncio.sleep(0)
        assert len(flooded.begun) == FLOOD  # and each of them has its turn
        assert not [task.exception() for task in (*others, pressing) if task.exception()]
