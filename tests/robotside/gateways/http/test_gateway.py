"""The HTTP gateway by itself: start and stop, its URL, and STOP through the door."""

from __future__ import annotations

import html
from collections.abc import AsyncIterator
from pathlib import Path

import httpx
import pytest

from bridge.core.errors import BridgeError
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.fakes import FakeRobot
from tests.robotside.scene import Scene
from tests.robotside.visitor import visitor


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    return Scene(FakeRobot(), tmp_path)


@pytest.fixture
async def pictures() -> AsyncIterator[PictureScaler]:
    made = PictureScaler()
    yield made
    await made.close()


async def test_it_is_stopped_without_having_been_started(scene: Scene, pictures: PictureScaler) -> None:
    await HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: "").stop()


async def test_stop_goes_by_the_door(scene: Scene, pictures: PictureScaler) -> None:
    gateway = HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: "ws://192.0.2.7:9090")
    await gateway.start()
    where = gateway.endpoints()["http"]
    assert where == f"http://127.0.0.1:{gateway.port}"
    async with visitor(where) as web:
        assert "ws://192.0.2.7:9090" in (await web.get("/")).text
        answer = await web.post("/stop?name=Fred")
        await gateway.stop()
        with pytest.raises(httpx.ConnectError):
            await web.get("/")
    assert (answer.status_code, answer.text) == (200, "Stopped.\n")
    assert scene.station.controls.stopped_by == "Fred at 127.0.0.1 (not proven)"


async def test_all_who_look_are_told_that_stop_is_pressed_and_by_whom(
    scene: Scene, pictures: PictureScaler
) -> None:
    gateway = HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: "ws://192.0.2.7:9090")
    await gateway.start()
    async with visitor(gateway.endpoints()["http"]) as web:
        assert "STOP is pressed" not in (await web.get("/")).text + (await web.get("/usage.txt")).text
        assert (await web.get("/healthz")).json()["stopped"] is False
        await web.post("/stop?name=<Fred>")
        said = "STOP is pressed by <Fred> at 127.0.0.1 (not proven); release it in the app."
        header = (await web.get("/")).text.partition("</header>")[0]
        assert html.escape(said) in header
        assert said in (await web.get("/usage.txt")).text
        assert (await web.get("/healthz")).json()["stopped"] is True
    await gateway.stop()


async def test_who_presses_stop_in_a_browser_sees_the_page_again_and_a_program_gets_a_sentence(
    scene: Scene, pictures: PictureScaler, caplog: pytest.LogCaptureFixture
) -> None:
    gateway = HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: "ws://192.0.2.7:9090")
    await gateway.start()
    where = gateway.endpoints()["http"]
    async with visitor(where) as web:
        assert (await web.get("/")).headers["referrer-policy"] == "same-origin", "else its origin is null"
        browser = {"Accept": "text/html,application/xhtml+xml,*/*;q=0.8", "Origin": where}
        answer = await web.post("/stop", headers=browser)
        assert (answer.status_code, answer.headers["location"]) == (303, "/")
        assert scene.station.controls.stopped
        program = await web.post("/stop", headers={"Accept": "*/*"})
        assert (program.status_code, program.text) == (200, "Stopped.\n")
    await gateway.stop()
    assert "refused" not in caplog.text


async def test_a_port_that_is_taken_is_one_sentence(scene: Scene, pictures: PictureScaler) -> None:
    first = HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: "")
    await first.start()
    second = HttpGateway(scene.door, "127.0.0.1", first.port, pictures, lambda: "")
    with pytest.raises(BridgeError, match="--http-port names another port"):
        await second.start()
    await second.stop()
    await first.stop()
