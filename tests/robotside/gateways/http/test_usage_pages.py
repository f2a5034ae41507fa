"""The usage sheet of a robot that runs: every example is taken from the page and done as it stands."""

from __future__ import annotations

import asyncio
import html
import json
import re
import shutil
import subprocess
import sys
from collections.abc import AsyncIterator
from pathlib import Path
from unittest.mock import AsyncMock

import pytest
import websockets

from app.discovery.known_robots import check_address
from bridge.core.identity import Role
from robotside.core.config import TrustSettings
from robotside.gateways.discovery import read_wish
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.payloads.offered import READ
from robotside.gateways.scaling.picture_scaling import PictureScaler
from robotside.serving.gateway_owner import GatewayOwner
from robotside.trust.qr import as_svg
from tests.fakes import FakeRobot
from tests.lacking import lacking
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene
from tests.robotside.serving.test_station_keys import serving as serving_with_keys
from tests.robotside.serving.test_station_server import serving
from tests.robotside.visitor import visitor

ROOT = Path(__file__).parents[4]


@pytest.fixture(autouse=True)
async def pool_ended() -> AsyncIterator[None]:
    """End the threads of the loop's own pool, in which a broker is connected to."""
    yield
    await asyncio.get_running_loop().shutdown_default_executor()


def shown(page: str, kind: str) -> list[str]:
    """The examples of one kind on the page, as a reader copies them."""
    return [
        html.unescape(text) for text in re.findall(rf'<pre class="{kind}"[^>]*>(.*?)</pre>', page, re.DOTALL)
    ]


async def run(*command: str, where: Path) -> tuple[int | None, str]:
    program = await asyncio.create_subprocess_exec(
        *command, cwd=where, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.STDOUT
    )
    said, _ = await program.communicate()
    return program.returncode, said.decode(errors="replace")


async def test_every_message_for_rosbridge_can_be_sent_as_it_stands(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        GatewayOwner, "bring_up", AsyncMock()
    )  # a broker on its usual port is not this test's to start
    async with asyncio.timeout(60), serving(tmp_path, EquippedRobot()) as serves:
        async with visitor(serves.addresses.http) as web:
            page = (await web.get("/")).text
        messages = shown(page, "rosbridge")
        assert len(messages) > 40
        async with websockets.connect(serves.addresses.bridge) as socket:
            await socket.send('{"op": "set_level", "level": "warning"}')
            for message in messages:
                await socket.send(message)
            await socket.send('{"op": "call_service", "service": "/rosapi/get_time", "id": "last"}')
            called = {json.loads(message).get("service") for message in messages} - {None}
            answers, left = [], {*called, "/rosapi/get_time"}
            while left:
                answers.append(json.loads(await socket.recv()))
                left.discard(answers[-1].get("service"))
    assert [said for said in answers if said["op"] == "status" and said["level"] == "error"] == []
    answered = {said["service"]: json.dumps(said) for said in answers if said["op"] == "service_response"}
    wrong = ("no field", "must be a", "cannot be read", "unknown service")
    assert [said for said in answered.values() if any(word in said for word in wrong)] == []


async def test_what_the_page_offers_is_what_the_robot_has(tmp_path: Path) -> None:
    async with asyncio.timeout(60), serving(tmp_path, EquippedRobot()) as serves:
        async with visitor(serves.addresses.http) as web:
            page, text = (await web.get("/")).text, (await web.get("/usage.txt")).text
        topics = {json.loads(line).get("topic") for line in shown(page, "rosbridge")}
        for name in ("/robot/info", "/cmd_vel"):
            assert name in topics
        assert f">{READ}</span>" in page
    assert all(line in text for line in shown(page, "shell"))


@pytest.mark.slow
async def test_every_line_for_a_shell_and_the_program_do_what_they_say(tmp_path: Path) -> None:
    if shutil.which("curl") is None:
        lacking("curl", "the page's lines are pasted into a shell")
    robot = EquippedRobot()
    async with asyncio.timeout(120), serving(tmp_path / "state", robot) as serves:
        async with visitor(serves.addresses.http) as web:
            page = (await web.get("/")).text
        commands = [line for line in shown(page, "shell") if "/snapshot/" not in line]
        assert len(commands) == 3
        for line in commands:
            code, said = await run("bash", "-c", f"{line} -sS --fail", where=tmp_path)
            assert code == 0, said
        assert serves.station.controls.stopped
        (program,) = shown(page, "python")
        code, said = await run(
            sys.executable, "-c", f"import sys; sys.path.insert(0, {str(ROOT)!r})\n{program}", where=tmp_path
        )
        assert code == 0, said
        assert "STOP" in said


@pytest.mark.slow
async def test_curl_knows_the_robot_by_the_key_on_the_page_and_nobody_else(tmp_path: Path) -> None:
    if shutil.which("curl") is None:
        lacking("curl", "the page's lines are pasted into a shell")
    async with asyncio.timeout(60), serving_with_keys(tmp_path) as (serves, keys, _):
        site = f"https://127.0.0.1:{serves.addresses.http_port}"
        curl = ["curl", "-sS", "--fail", "-k", f"{site}/healthz", "--pinnedpubkey"]
        assert (await run(*curl, f"sha256//{keys.pin}", where=tmp_path))[0] == 0
        wrong = f"sha256//{'A' * 43}="
        code, said = await run(*curl, wrong, where=tmp_path)
        assert code == 90, said
        code, page = await run("curl", "-sS", "-k", f"{site}/usage.txt", where=tmp_path)
        assert f"--pinnedpubkey sha256//{keys.pin} " in page


@pytest.mark.slow
async def test_a_gateway_is_on_the_page_while_it_is_up_and_its_lines_are_understood(tmp_path: Path) -> None:
    if shutil.which("mosquitto_pub") is None:
        lacking("mosquitto", "its clients are pasted into a shell")
    adapter, url = read_wish("mqtt=own://127.0.0.1:0")
    async with asyncio.timeout(120), serving(tmp_path / "state", EquippedRobot()) as serves:
        await serves.gateways.bring_up(adapter, url)
        async with visitor(serves.addresses.http) as web:
            (guide,) = shown((await web.get("/")).text, "guide")
            stop = next(
                line.strip()
                for line in guide.splitlines()
                if line.strip().startswith("mosquitto_pub") and "/call/stop " in line
            )
            code, said = await run("bash", "-c", stop, where=tmp_path)
            assert (code, said) == (0, "")
            while not serves.station.controls.stopped:  # noqa: ASYNC110 - what is waited for is no event
                await asyncio.sleep(0.01)
            await serves.gateways.bring_down("mqtt")
            assert shown((await web.get("/")).text, "guide") == []


async def test_a_stranger_sees_no_more_than_a_name_stop_and_where_to_log_in(tmp_path: Path) -> None:
    async with serving_with_keys(tmp_path, settings=TrustSettings(local_role="none")) as (serves, keys, _):
        offer = keys.pairing.open(Role.DRIVE)
        async with visitor(serves.addresses.http) as web:
            page, text = await web.get("/"), await web.get("/usage.txt")
    assert (page.status_code, text.status_code) == (200, 401)
    assert "Rex" in page.text
    assert 'action="/stop"' in page.text
    for secret in (
        serves.addresses.bridge,
        "/cmd_vel",
        "<svg",
        "pilothouse://",
        offer.secret,
        "mqtt",
        "curl",
    ):
        assert secret not in page.text + text.text, secret


@pytest.mark.parametrize("bridge", ["ws://192.0.2.7:9090", "wss://[2001:db8::7]:9091"])
async def test_the_qr_code_says_where_the_app_connects_to(tmp_path: Path, bridge: str) -> None:
    scene, pictures = Scene(FakeRobot(), tmp_path), PictureScaler()
    gateway = HttpGateway(scene.door, "127.0.0.1", 0, pictures, lambda: bridge)
    await gateway.start()
    async with visitor(gateway.endpoints()["http"]) as web:
        page = (await web.get("/")).text
    await gateway.stop()
    await pictures.close()
    (link,) = (html.unescape(text) for text in re.findall(r'href="(pilothouse:[^"]*)"', page))
    assert check_address(link) == bridge, "as the app reads it"
    assert as_svg(link) in page


async def test_who_manages_sees_how_to_pair_in_place_of_where_to_connect(tmp_path: Path) -> None:
    async with serving_with_keys(tmp_path) as (serves, keys, _), visitor(serves.addresses.http) as web:
        assert "Pairing is closed" in (await web.get("/")).text
        offer = keys.pairing.open(Role.DRIVE)
        page = (await web.get("/")).text
    assert as_svg(keys.pairing.link(offer)) in page
    assert page.count("<svg") == 1, "one code to scan"


async def test_the_page_takes_nothing_from_elsewhere_and_runs_no_script(tmp_path: Path) -> None:
    async with serving_with_keys(tmp_path) as (serves, _, _), visitor(serves.addresses.http) as web:
        policy = (await web.get("/")).headers["content-security-policy"]
    assert "default-src 'none'" in policy
    assert "script-src" not in policy
    assert "frame-ancestors 'none'" in policy


def test_a_robot_of_which_nobody_asks_loads_no_sheet_and_nothing_for_film() -> None:
    heavy = ["mako", "questionary", "prompt_toolkit", "robotside.gateways.payloads.table", "av", "aiortc"]
    code = f"import sys, robotside.__main__; print([name for name in {heavy} if name in sys.modules])"
    said = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert said.stdout == "[]\n"
