"""Applications of others on the web site: whom the doorkeeper lets through to them, and that they come and go."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any

import httpx
import pytest
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route
from starlette.types import ASGIApp, Scope

from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.server.reception.places import FULL, Limits
from robotside.door.station_door import StationDoor
from robotside.gateways.http import browser_connection as visit
from robotside.gateways.http import gateway as module
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.http.mounts import LONG, ONLY_STOP, OPERATOR, STAYS, Mounts
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.fakes import FakeRobot
from tests.robotside.gateways.http.test_doorkeeper import Gate
from tests.robotside.scene import Scene
from tests.robotside.visitor import visitor

TIMEOUT = 60.0


class Application:
    """Says who asks; presses STOP at `/stop`."""

    def __init__(self, door: StationDoor) -> None:
        self._door = door
        self.asked: list[Operator] = []
        self.began, self.over = asyncio.Event(), asyncio.Event()
        self.app: ASGIApp = Starlette(
            routes=[
                Route("/", self.who),
                Route("/who", self.who, methods=["GET", "POST"]),
                Route("/stop", self.stop, methods=["POST"]),
                Route("/stay", self.stay),
                Route("/slow", self.slow),
                Route("/long", self.long),
            ]
        )

    async def who(self, request: Request) -> Response:
        operator = getattr(request.state, OPERATOR)
        self.asked.append(operator)
        role = operator.role(self._door.now()).word
        path = [request.scope["root_path"], request.url.path]
        return JSONResponse([operator.way, operator.identity.name, role, *path])

    async def stop(self, request: Request) -> Response:
        assert getattr(request.state, ONLY_STOP)
        operator = getattr(request.state, OPERATOR)
        self.asked.append(operator)
        return PlainTextResponse((await self._door.stop(operator)).message)

    async def stay(self, request: Request) -> Response:
        setattr(request.state, STAYS, True)
        return await self.who(request)

    async def slow(self, _: Request) -> Response:
        self.began.set()
        await asyncio.Event().wait()
        return Response()

    async def long(self, request: Request) -> Response:
        async def pieces() -> AsyncIterator[bytes]:
            yield b"one "
            self.began.set()
            await self.over.wait()
            yield b"two"

        setattr(request.state, LONG, True)
        return StreamingResponse(pieces())


def presses_stop(scope: Scope) -> bool:
    return scope["path"] == "/api/stop" and scope["method"] == "POST"


def written(_: Scope, status: int, refusal: BridgeError) -> Response:
    return JSONResponse({"said": str(refusal)}, status)


async def done(is_done: Callable[[], bool]) -> None:
    """Until it is."""
    async with asyncio.timeout(TIMEOUT):
        while not is_done():  # noqa: ASYNC110 - nothing says when
            await asyncio.sleep(0.01)


class Site:
    """A served site with one application on it."""

    def __init__(self, scene: Scene, gateway: HttpGateway, app: Application) -> None:
        self.scene, self.gateway, self.app = scene, gateway, app

    def mount(self, role: Role | None = None, **words: Any) -> Any:
        return self.gateway.mounts.mount(
            "/api", self.app.app, way="rest", role=role, presses_stop=presses_stop, **words
        )

    def visit(self, token: str = "", **headers: str) -> httpx.AsyncClient:
        shown = {"Authorization": f"Bearer {token}"} if token else {}
        return visitor(self.gateway.endpoints()["http"], headers=shown | headers, timeout=TIMEOUT)

    @property
    def stopped(self) -> bool:
        return self.scene.station.controls.stopped


@contextlib.asynccontextmanager
async def a_site(state: Path, **words: Any) -> AsyncIterator[Site]:
    scene = Scene(FakeRobot(), state)
    door, pictures = StationDoor(scene.station, Gate()), PictureScaler()
    gateway = HttpGateway(door, "127.0.0.1", 0, pictures, lambda: "", **words)
    await gateway.start()
    try:
        yield Site(scene, gateway, Application(door))
    finally:
        await gateway.stop()
        await pictures.close()


@pytest.fixture
async def site(tmp_path: Path) -> AsyncIterator[Site]:
    async with a_site(tmp_path) as site:
        yield site


async def test_a_request_comes_with_its_operator_and_finds_nothing_once_unmounted(site: Site) -> None:
    async with site.visit("w.key") as web:
        assert (await web.get("/api/who")).status_code == 404
        end = site.mount()
        assert (await web.get("/api/who")).json() == ["rest", "Person w", "watch", "/api", "/api/who"]
        assert (await web.get("/api")).json()[3:] == ["/api", "/api/"]
        assert (await web.get("/apis")).status_code == 404  # of the site
        end()
        end()
        assert (await web.get("/api/who")).status_code == 404
        site.mount()
        assert (await web.get("/api/who")).status_code == 200
    assert site.gateway.mounts.url("/api") == f"http://127.0.0.1:{site.gateway.port}/api"


@pytest.mark.parametrize("path", ["/api", "/api/v2", "/stop", "/stream", "/stream/api", "/snapshot/x"])
def test_a_path_that_is_taken_is_refused(site: Site, path: str) -> None:
    site.gateway.mounts.mount("/api", site.app.app, way="rest")
    with pytest.raises(BridgeError, match=f"The path {path} of the web site is taken"):
        site.gateway.mounts.mount(path, site.app.app, way="soap")


@pytest.mark.parametrize("path", ["", "/", "api", "/api/", "/a b", "//api", "/api?x"])
def test_what_is_no_path_is_refused(path: str) -> None:
    mounts = Mounts(str)
    with pytest.raises(BridgeError, match="is written as /api"):
        mounts.mount(path, Starlette(), way="rest")


def test_paths_that_only_begin_alike_are_two() -> None:
    mounts = Mounts(str)
    mounts.mount("/api", Starlette(), way="rest")
    mounts.mount("/apis", Starlette(), way="soap")
    assert [found and found.way for found in map(mounts.at, ("/api/x", "/apis", "/ap"))] == [
        "rest",
        "soap",
        None,
    ]


@pytest.mark.parametrize("token", ["", "n.key", "x.key"])
async def test_who_has_no_role_reaches_nothing_but_stop(site: Site, token: str) -> None:
    site.mount(written=written)
    async with site.visit(token) as web:
        for path in ("/api", "/api/who", "/api/nowhere"):
            answer = await web.get(path)
            assert answer.status_code == 401
            assert answer.json()["said"].endswith(".")
            assert answer.headers["www-authenticate"] == "Bearer"
        assert (await web.get("/api/stop")).status_code == 401
        assert not site.app.asked
        assert not site.stopped
        assert (await web.post("/api/stop")).status_code == 200
    assert site.stopped


async def test_a_page_of_others_may_press_stop_and_nothing_else(site: Site) -> None:
    site.mount(Role.DRIVE)
    async with site.visit("m.key", Origin="https://evil.example") as web:
        assert (await web.post("/api/who")).status_code == 403
        assert not site.app.asked
        assert (await web.post("/api/stop")).status_code == 200
    assert site.stopped
    assert site.app.asked[0].role(0.0) is Role.NONE


async def test_the_role_of_who_has_no_token_is_that_of_the_mount(site: Site) -> None:
    site.mount(Role.DRIVE)
    async with site.visit() as web:
        assert (await web.get("/api/who")).json()[2] == "drive"
        assert (await web.get("/nowhere")).status_code == 401  # of the site
        assert (await web.get("/api/who", headers={"Authorization": "Bearer w.key"})).json()[2] == "watch"


async def test_in_clear_where_that_is_not_allowed_stop_is_pressed_and_nothing_else(tmp_path: Path) -> None:
    async with a_site(tmp_path, plain_from=lambda _: False) as site:
        site.mount(Role.DRIVE, written=written)
        async with site.visit("m.key") as web:
            answer = await web.post("/api/who")
            assert answer.status_code == 426
            assert "use https://" in answer.json()["said"]
            assert not site.app.asked
            assert (await web.post("/api/stop")).status_code == 200
        assert site.stopped


async def test_on_the_reserve_stop_is_pressed_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "LIMITS", Limits(total=1))
    async with a_site(tmp_path) as site:
        site.mount()
        async with site.visit("w.key") as first, site.visit("n.key") as late:
            slow = asyncio.create_task(first.get("/api/slow"))
            await site.app.began.wait()
            answer = await late.get("/api/who")
            assert (answer.status_code, answer.text) == (503, f"{FULL}\n")
            assert (await late.post("/api/stop")).status_code == 200
            slow.cancel()
            await asyncio.gather(slow, return_exceptions=True)
        assert site.stopped


async def test_an_operator_leaves_with_its_answer_but_one_that_is_kept_stays(site: Site) -> None:
    site.mount()
    gone: list[Operator] = []
    site.gateway.site._door._on_gone = gone.append
    async with site.visit("w.key") as web:
        await web.get("/api/who")
        assert gone == site.app.asked
        await web.get("/api/stay")
        assert gone == site.app.asked[:1]


async def test_unmounting_ends_answers_that_are_under_way(
    site: Site, caplog: pytest.LogCaptureFixture
) -> None:
    end = site.mount(written=written)
    before = asyncio.all_tasks()
    async with site.visit("w.key") as web:
        for path, status, text in (
            ("/api/slow", 503, '{"said":"This gateway was brought down."}'),
            ("/api/long", 200, "one "),
        ):
            asking = asyncio.create_task(web.get(path))
            await site.app.began.wait()
            site.app.began.clear()
            end()
            answer = await asking
            assert (answer.status_code, answer.text) == (status, text)
            end = site.mount(written=written)
        assert (await web.get("/api/who")).status_code == 200
    await done(lambda: not asyncio.all_tasks() - before)
    assert not caplog.records


async def test_a_request_that_unmounts_its_own_application_is_answered(site: Site) -> None:
    async def leave(_: Request) -> Response:
        end()
        await asyncio.sleep(0)
        return PlainTextResponse("gone")

    end = site.gateway.mounts.mount("/api", Starlette(routes=[Route("/end", leave)]), way="rest")
    async with site.visit("w.key") as web:
        assert (await web.get("/api/end")).text == "gone"
        assert (await web.get("/api/end")).status_code == 404


async def test_an_answer_that_goes_on_is_not_ended_with_its_connections_time(
    site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(visit, "STUCK_TIMEOUT", 0.01)
    looked = 0
    look = visit.BrowserConnection._look

    def counting(self: visit.BrowserConnection) -> None:
        nonlocal looked
        looked += self.asking
        look(self)

    site.mount()
    async with site.visit("w.key") as web:
        reading = asyncio.create_task(web.get("/api/long"))
        await site.app.began.wait()
        monkeypatch.setattr(visit.BrowserConnection, "_look", counting)
        for connection in site.gateway._server.server_state.connections:  # type: ignore[union-attr]
            connection.until = 0.0  # type: ignore[union-attr]
            connection._look_later()  # type: ignore[union-attr]
        await done(lambda: looked >= 3)
        site.app.over.set()
        assert (await reading).text == "one two"


async def test_who_has_a_role_goes_on_asking_on_one_connection_and_a_stranger_has_its_time(
    site: Site,
) -> None:
    site.mount()
    loop = asyncio.get_running_loop()
    for token, renewed in (("w.key", True), ("", False)):
        async with site.visit(token) as web:
            await web.get("/api/who")
            (connection,) = site.gateway._server.server_state.connections  # type: ignore[union-attr]
            connection.until = 0.0  # type: ignore[union-attr]
            await web.get("/api/who")
            assert (connection.until > loop.time()) is renewed  # type: ignore[union-attr]
        await done(lambda: not site.gateway._server.server_state.connections)  # type: ignore[union-attr]
