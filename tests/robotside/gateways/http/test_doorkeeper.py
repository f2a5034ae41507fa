"""The web site for people of each role, for strangers, and for pages of others."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from pathlib import Path

import httpx
import msgspec
import pytest

from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from bridge.core.topics import CAMERA
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.door.station_door import StationDoor
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from robotside.trust.permissions import needed_role
from tests.fakes import FakeRobot
from tests.lacking import package
from tests.robotside.gateways.video.scenes import numbered, seen
from tests.robotside.scene import Scene
from tests.robotside.visitor import visitor

KEYS = {"w.key": Role.WATCH, "n.key": Role.NONE, "m.key": Role.MANAGE}


class Gate:
    """Knows two people; everybody else is a stranger, trusted or not."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return STRANGER

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        if token not in KEYS:
            raise Refused("This key is not known here.")
        return Identity(token[0], f"Person {token[0]}", KEYS[token], proven=True)

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


class Site:
    """A site that is served, and its robot."""

    def __init__(self, scene: Scene, door: StationDoor, gateway: HttpGateway) -> None:
        self.scene, self.door, self.gateway = scene, door, gateway

    def visit(self, token: str = "", **headers: str) -> httpx.AsyncClient:
        shown = {"Authorization": f"Bearer {token}"} if token else {}
        return visitor(self.gateway.endpoints()["http"], headers=shown | headers)

    @property
    def stopped_by(self) -> str:
        return self.scene.station.controls.stopped_by


@pytest.fixture
async def site(tmp_path: Path) -> AsyncIterator[Site]:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, cameras=["front"], description="Patrols the yard")
    scene = Scene(robot, tmp_path)
    door, pictures = StationDoor(scene.station, Gate()), PictureScaler()
    gateway = HttpGateway(door, "127.0.0.1", 0, pictures, lambda: "ws://127.0.0.1:9090")
    await gateway.start()
    yield Site(scene, door, gateway)
    await gateway.stop()
    await pictures.close()


async def test_a_stranger_sees_a_name_a_stop_button_and_where_to_show_a_token(site: Site) -> None:
    async with site.visit() as web:
        page = (await web.get("/")).text
        assert site.door.info.name in page
        assert 'action="/stop"' in page
        assert 'action="/login"' in page
        assert "Patrols the yard" not in page
        assert "/cmd_vel" not in page
        assert "STOP is pressed" not in page
        assert (await web.get("/healthz")).json() == {"ok": True}
        await web.post("/stop?name=Fred")
        page = (await web.get("/")).text
        assert "STOP is pressed; release it in the app." in page
        assert "Fred" not in page
        assert (await web.get("/healthz")).json() == {"ok": True}


@pytest.mark.parametrize(
    "path",
    [
        "/snapshot/front.jpg",
        "/snapshot/front.png",
        "/stream/front.mjpeg",
        "/stream/front.mp4",
        "/nowhere",
        "/docs",
    ],
)
async def test_a_stranger_sees_nothing_else(site: Site, path: str) -> None:
    for token in ("", "n.key"):
        async with site.visit(token) as web:
            answer = await web.get(path)
            assert answer.status_code == 401
            assert answer.text.count(".") == 1 or path.endswith((".jpg", ".png", ".mjpeg", ".mp4"))
    assert not site.scene.robot.wanted.get(CAMERA)


async def test_who_watches_sees_the_page_and_the_robots_health(site: Site) -> None:
    async with site.visit("w.key") as web:
        assert "Patrols the yard" in (await web.get("/")).text
        assert len((await web.get("/healthz")).json()) > 1


@pytest.mark.parametrize("path", ["/", "/healthz", "/snapshot/front.jpg"])
async def test_a_wrong_token_is_one_sentence(site: Site, path: str) -> None:
    async with site.visit("x.key") as web:
        answer = await web.get(path)
        assert (answer.status_code, answer.text) == (401, "This key is not known here.\n")


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"Origin": "https://evil.example"},
        {"Origin": "null", "Content-Type": "application/x-www-form-urlencoded"},
        {"Host": "evil.example"},
        {"Authorization": "Bearer x.key"},
        {"Cookie": "pilothouse_1=gone"},
    ],
)
async def test_stop_is_pressed_by_anyone_from_anywhere(site: Site, headers: dict[str, str]) -> None:
    async with site.visit(**headers) as web:
        assert (await web.post("/stop?name=Fred")).status_code == 200
    assert site.stopped_by == "Fred at 127.0.0.1 (not proven)"


async def test_who_proved_who_it_is_stops_under_its_own_name(site: Site) -> None:
    async with site.visit("w.key") as web:
        await web.post("/stop?name=Somebody+else")
    assert site.stopped_by == "Person w"
    assert site.scene.station.controls.stopped_by_id == "w"
    (row,) = (each for each in site.scene.station.records.audit.rows() if each.operation == "stop")
    assert (row.person_id, row.name, row.role) == ("w", "Person w", "watch")


@pytest.mark.parametrize(
    "headers", [{"Origin": "https://evil.example"}, {"Origin": "null"}, {"Host": "evil.example:8080"}]
)
@pytest.mark.parametrize(("method", "path"), [("GET", "/"), ("POST", "/login"), ("POST", "/logout")])
async def test_a_page_of_others_gets_nothing_even_with_a_token(
    site: Site, headers: dict[str, str], method: str, path: str
) -> None:
    async with site.visit("w.key", **headers) as web:
        assert (await web.request(method, path)).status_code == 403


async def test_a_token_that_is_shown_in_the_form_stays_as_a_cookie_until_it_is_given_back(site: Site) -> None:
    async with site.visit() as web:
        answer = await web.post("/login", data={"token": "w.key"})
        assert (answer.status_code, answer.headers["location"]) == (303, "/")
        crumbs = answer.headers["set-cookie"].lower()
        assert "httponly" in crumbs
        assert "samesite=strict" in crumbs
        assert "secure" not in crumbs  # it came without TLS
        assert "Patrols the yard" in (await web.get("/")).text
        assert (
            "Patrols the yard" in (await web.get("/", headers={"Origin": str(web.base_url).rstrip("/")})).text
        )
        await web.post("/logout")
        assert "Patrols the yard" not in (await web.get("/")).text


@pytest.mark.parametrize(
    "form",
    [{}, {"token": "x.key"}, {"token": "a\r\nSet-Cookie: b=c"}, {"token": "a" * 600}, {"other": "x" * 9000}],
)
async def test_a_form_without_a_right_token_gives_no_cookie(site: Site, form: dict[str, str]) -> None:
    async with site.visit() as web:
        answer = await web.post("/login", data=form)
        assert answer.status_code == 401
        assert "set-cookie" not in answer.headers
        assert 'action="/login"' in answer.text


async def test_a_cookie_that_ended_makes_a_stranger_and_locks_nobody_out(site: Site) -> None:
    cookie = f"pilothouse_{site.gateway.port}=x.key"
    async with site.visit(Cookie=cookie) as web:
        assert 'action="/login"' in (await web.get("/")).text


async def test_a_stream_ends_when_its_viewer_may_nothing_any_more(site: Site) -> None:
    async with site.visit("w.key") as web, web.stream("GET", "/stream/front.mjpeg") as stream:
        chunks = stream.aiter_raw()
        async with asyncio.timeout(60):
            await anext(chunks)
            site.scene.station.bus.publish(CAMERA, CompressedImage(data=b"a picture"))
            assert b"a picture" in await anext(chunks)
            site.door.expel(["w"])
            site.scene.station.bus.publish(CAMERA, CompressedImage(data=b"a secret"))
            assert b"a secret" not in b"".join([chunk async for chunk in chunks])
    assert not site.scene.robot.wanted[CAMERA]


async def test_a_film_ends_when_its_viewer_may_nothing_any_more_and_the_camera_rests(site: Site) -> None:
    package("av")
    async with site.visit("w.key") as web, web.stream("GET", "/stream/front.webm") as stream:
        chunks, film = stream.aiter_raw(), b""
        async with asyncio.timeout(60):
            while not film:
                site.scene.station.bus.publish(CAMERA, CompressedImage(data=numbered(1)))
                film += await anext(chunks)
            site.door.expel(["w"])
            site.scene.station.bus.publish(CAMERA, CompressedImage(data=numbered(9)))
            film += b"".join([chunk async for chunk in chunks])
    assert {each.number for each in seen(film)} == {1}
    assert not site.scene.robot.wanted[CAMERA]


async def test_the_audit_log_is_a_file_for_who_manages_and_for_nobody_else(site: Site) -> None:
    async with site.visit() as stranger, site.visit("w.key") as watching:
        assert (await stranger.get("/audit.csv")).status_code == 401
        assert (await watching.get("/audit.csv")).status_code == 403
    async with site.visit("m.key") as managing:
        answer = await managing.get("/audit.csv")
    assert answer.status_code == 200
    assert answer.headers["content-type"].startswith("text/csv")
    lines = answer.text.splitlines()
    assert lines[0].startswith("number,time,person_id,name,role,way")
    assert any("Person w,watch,http,127.0.0.1,page /audit.csv,refused trust_role" in line for line in lines)
    assert any("Person m,manage,http,127.0.0.1,page /audit.csv,done" in line for line in lines)


async def test_who_comes_in_clear_where_that_is_not_allowed_may_press_stop_and_nothing_else(
    tmp_path: Path,
) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    door, pictures = StationDoor(scene.station, Gate()), PictureScaler()
    gateway = HttpGateway(
        door, "127.0.0.1", 0, pictures, lambda: "", plain_from=lambda host: host != "127.0.0.1"
    )
    await gateway.start()
    try:
        async with visitor(gateway.endpoints()["http"]) as web:
            for path in ("/", "/healthz", "/snapshot/front.jpg"):
                answer = await web.get(path, headers={"Authorization": "Bearer m.key"})
                assert answer.status_code == 426
                assert f"use https://127.0.0.1:{gateway.port}." in answer.text
            assert not scene.station.controls.stopped
            assert (await web.post("/stop")).status_code == 200
            assert scene.station.controls.stopped
    finally:
        await gateway.stop()
        await pictures.close()
