"""The REST gateway: STOP for anyone, driving that ends with silence, clients that stay who they are, and nothing left."""

from __future__ import annotations

import asyncio
import contextlib
import threading
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from bridge.core.errors import BridgeError
from bridge.core.identity import Identity, Role
from bridge.core.link_state import CONTROL_TIMEOUT
from robotside.gateways.adapter import Surroundings
from robotside.gateways.gateway_url import read_url
from robotside.gateways.plain import callers
from robotside.gateways.plain.known_clients import IDLE_TIMEOUT
from robotside.gateways.rest import gateway
from robotside.gateways.rest.adapter import ADAPTER
from robotside.gateways.rest.application import application
from robotside.gateways.rest.gateway import RestGateway
from tests.fakes import FakeRobot
from tests.robotside.gateways.http.test_doorkeeper import Gate
from tests.robotside.gateways.rest.served import Served, serving
from tests.robotside.scene import Scene

AHEAD = {"linear": {"x": 0.2}}


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    made = Scene(FakeRobot(), tmp_path)
    made.run(1.0)
    return made


@pytest.fixture
async def served(scene: Scene) -> AsyncIterator[Served]:
    async with serving(scene) as served:
        yield served


async def push(served: Served, web: httpx.AsyncClient, stamp: float | None = None) -> httpx.Response:
    stamped = served.scene.clock if stamp is None else stamp
    return await web.post("topics/cmd_vel", json=AHEAD, headers={"Stamp": f"{stamped:.6f}"})


async def drive(served: Served, web: httpx.AsyncClient) -> None:
    """Take control, and drive for a moment."""
    assert (await web.get("time")).status_code == 200
    assert (await web.post("control")).json()["success"]
    rest = {"Stamp": f"{served.scene.clock:.6f}"}
    await web.post("topics/cmd_vel", json={}, headers=rest)
    served.scene.run(0.05)
    for _ in range(3):
        assert (await push(served, web)).status_code == 202
        served.scene.run(0.1)
    assert not served.scene.robot.at_rest


# STOP


@pytest.mark.parametrize(
    ("how", "token", "headers", "body"),
    [
        ("plain", "", {}, b""),
        ("wrong key", "x.key", {}, b""),
        ("page of others", "", {"Origin": "https://evil.example"}, b""),
        ("no form", "", {"Accept": "image/png"}, b""),
        ("wrong body", "w.key", {"Content-Type": "image/png"}, b"\xff{"),
        ("too long", "", {"Content-Type": "application/json"}, b"x" * 100_000),
        ("wrong headers", "", {"Stamp": "never", "Client-Id": "x" * 1000}, b"{}"),
    ],
)
async def test_stop_is_pressed_for_anyone_whatever_else_is_said(
    scene: Scene, how: str, token: str, headers: dict[str, str], body: bytes
) -> None:
    async with serving(scene, gate=Gate()) as served, served.client(token) as web:
        answer = await web.post("stop", content=body, headers=headers)
        assert answer.status_code == 200, (how, answer.text)
        assert answer.json()["success"]
        assert scene.station.controls.stopped


@pytest.mark.parametrize("path", ["stop/", "services/stop", "services/stop/"])
async def test_stop_is_pressed_by_each_of_its_paths(scene: Scene, path: str) -> None:
    async with serving(scene, gate=Gate()) as served, served.client("x.key") as web:
        assert (await web.post(path)).status_code == 200
        assert scene.station.controls.stopped


async def test_stop_does_not_wait_for_a_body_that_never_comes(scene: Scene) -> None:
    async with serving(scene, gate=Gate()) as served:
        reader, writer = await asyncio.open_connection("127.0.0.1", served.http.port)
        writer.write(b"POST /api/stop HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 1000\r\n\r\n{")
        async with asyncio.timeout(60):
            assert b" 200 " in await reader.readline()
        assert scene.station.controls.stopped
        writer.close()


async def test_stop_is_pressed_under_the_name_that_is_given_and_without_tls(scene: Scene) -> None:
    async with serving(scene, gate=Gate(), plain_from=lambda _: False) as served, served.client() as web:
        assert (await web.get("robot")).status_code == 426
        assert (await web.post("stop", headers={"Client-Name": "Fred"})).status_code == 200
        assert scene.station.controls.stopped_by == "Fred at 127.0.0.1 (not proven)"


async def test_stop_is_pressed_while_the_gateway_is_full(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(callers, "MAX_VISITORS", 3)
    async with served.client() as web:
        for number in range(3):
            assert (await web.get("time", headers={"Client-Id": str(number)})).status_code == 200
        answer = await web.get("time", headers={"Client-Id": "late"})
        assert (answer.status_code, answer.json()["code"]) == (503, "gateway_full")
        assert (await web.post("stop")).status_code == 200
        assert served.scene.station.controls.stopped
        assert (await web.get("time", headers={"Client-Id": "0"})).status_code == 200
        served.scene.run(6.0)
        assert (await web.get("time", headers={"Client-Id": "late"})).status_code == 200


# driving


async def test_a_driver_that_falls_silent_leaves_a_robot_at_rest_and_control_lapses(served: Served) -> None:
    async with served.client(Client_Id="me") as web:
        await drive(served, web)
        served.scene.run(0.35)
        assert served.scene.robot.at_rest
        assert served.scene.station.controls.driver is not None
        served.scene.run(CONTROL_TIMEOUT + 0.1)
        assert served.scene.station.controls.driver is None


async def test_a_drive_command_needs_a_stamp_of_the_robots_time_that_is_fresh(served: Served) -> None:
    async with served.client(Client_Id="me") as web:
        assert (await web.post("control")).json()["success"]
        answer = await push(served, web)
        assert (answer.status_code, answer.json()["code"]) == (409, "drive_clock_unknown")
        await web.get("time")
        answer = await web.post("topics/cmd_vel", json={})  # released before it is pushed
        assert answer.status_code == 202, "to rest needs no stamp"
        served.scene.run(0.05)
        answer = await web.post("topics/cmd_vel", json=AHEAD)
        assert (answer.status_code, answer.json()["code"]) == (422, "drive_unstamped")
        served.scene.run(0.1)
        assert served.scene.robot.at_rest
        now = served.scene.clock
        for stamp in ("never", "nan", "inf", ""):
            answer = await web.post("topics/cmd_vel", json=AHEAD, headers={"Stamp": stamp})
            assert answer.status_code == 422
            assert "time in seconds" in answer.json()["message"]
        for stamp in (now - 1.0, now + 60.0):
            answer = await push(served, web, stamp)
            assert answer.status_code == 409
            assert answer.json()["code"] in ("drive_late", "drive_clock_ahead")
        served.scene.run(0.1)
        assert served.scene.robot.at_rest


async def test_what_the_robot_does_not_obey_is_refused_with_the_reason_of_its_own_judge(
    served: Served,
) -> None:
    goal = {"header": {"frame_id": "map"}, "pose": {"position": {"x": 1.0}, "orientation": {"w": 1.0}}}
    async with served.client(Client_Id="me") as me, served.client(Client_Id="other") as other:
        await drive(served, me)
        await other.get("time")
        served.scene.run(0.05)
        for answer in (await push(served, other), await other.post("topics/goal_pose", json=goal)):
            assert (answer.status_code, answer.json()["code"]) == (409, "control_held")
        await other.post("stop")
        served.scene.run(0.05)
        for answer in (await push(served, me), await me.post("topics/goal_pose", json=goal)):
            assert (answer.status_code, answer.json()["code"]) == (409, "stop_is_pressed")
            assert not answer.json()["success"]
        assert served.scene.robot.at_rest


async def test_one_client_drives_and_others_of_the_same_machine_do_not(served: Served) -> None:
    async with served.client(Client_Id="me") as me, served.client(Client_Id="other") as other:
        await drive(served, me)
        answer = await other.post("control")
        assert (answer.status_code, answer.json()["code"]) == (409, "control_held")
        answer = await other.post(
            "services/control/acquire", json={"client_id": "third"}, headers={"Client-Id": ""}
        )
        assert answer.json()["code"] == "control_held"
        await other.get("time")
        served.scene.run(0.4)
        await push(served, other)
        served.scene.run(0.1)
        assert served.scene.robot.at_rest
        assert (await me.delete("control")).json()["success"]
        await drive(served, other)


async def test_who_may_nothing_any_more_drives_no_more(scene: Scene) -> None:
    async with serving(scene, gate=Gate()) as served, served.client("m.key", Client_Id="me") as web:
        await drive(served, web)
        served.door.expel({"m"})
        assert scene.station.controls.driver is None
        scene.run(0.05)
        assert scene.robot.at_rest
        assert not served.rest._desk.clients._known


async def test_whose_role_is_another_one_begins_anew(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    gate = Gate()
    async with serving(scene, gate=gate) as served, served.client("m.key", Client_Id="me") as web:
        await drive(served, web)
        monkeypatch.setattr(gate, "identify", lambda *_: Identity("m", "Person m", Role.WATCH, proven=True))
        assert (await web.get("time")).status_code == 200
        assert scene.station.controls.driver is None
        assert (await web.post("control")).status_code == 403


async def test_a_client_that_is_silent_for_long_is_forgotten(served: Served) -> None:
    async with served.client(Client_Id="me") as web:
        await web.get("time")
        known = served.rest._desk.clients
        assert len(known) == 1
        served.scene.clock += IDLE_TIMEOUT + 1.0
        known.leave_silent()
        assert len(known) == 0
        assert not served.door._operators


# once


async def test_a_command_that_is_sent_again_with_its_key_is_done_once(served: Served) -> None:
    async with served.client(Client_Id="me") as web:
        key = {"Idempotency-Key": "a-1"}
        first = await web.post("places", json={"name": "Office 1"}, headers=key)
        again = await web.post("places", json={"name": "Office 1"}, headers=key)
        assert first.json() == again.json()
        assert first.json()["success"]
        assert len((await web.get("places")).json()["places"]) == 1
        body = {"place": {"name": "B"}, "command_id": "other"}
        answer = await web.post("services/places/set", json=body, headers=key)
        assert answer.status_code == 422
        assert "Idempotency-Key and the field command_id differ" in answer.json()["message"]
        for name in ("Idempotency-Key", "Client-Id", "Client-Name"):
            answer = await web.post("places", json={"name": "C"}, headers={name: "x" * 65})
            assert answer.status_code == 422
            assert f"header {name} has at most 64 letters" in answer.json()["message"]
        assert len((await web.get("places")).json()["places"]) == 1


async def test_a_command_that_is_too_old_is_refused(served: Served) -> None:
    async with served.client(Client_Id="me") as web:
        old = {"Stamp": str(served.scene.clock - 6.0)}
        answer = await web.post("places", json={"name": "Office 1"}, headers=old)
        assert (answer.status_code, answer.json()["code"]) == (409, "command_late")
        goal = {"header": {"frame_id": "map"}, "pose": {"position": {"x": 1.0}, "orientation": {"w": 1.0}}}
        answer = await web.post("topics/goal_pose", json=goal, headers=old)
        assert (answer.status_code, answer.json()["code"]) == (409, "command_late")
        answer = await web.post("topics/goal_pose", json=goal)
        assert (answer.status_code, answer.json()["code"]) == (409, "position_unknown"), "fresh enough"


# up and down


async def test_nothing_is_left_of_a_gateway_that_was_brought_down(scene: Scene) -> None:
    before = asyncio.all_tasks()
    async with serving(scene) as served:
        running = asyncio.all_tasks()
        async with served.client(Client_Id="me") as web:
            await drive(served, web)
            streaming = asyncio.create_task(web.get("topics/odom/stream"))
            async with asyncio.timeout(60):
                while not served.door._subscriptions:  # noqa: ASYNC110 - nothing says when
                    await asyncio.sleep(0.01)
            await served.rest.stop()
            assert (await streaming).status_code == 200
            assert scene.station.controls.driver is None
            scene.run(0.05)
            assert scene.robot.at_rest
            assert (await web.get("robot")).status_code == 404
            async with asyncio.timeout(60):
                while served.door._subscriptions or served.door._operators:  # noqa: ASYNC110
                    await asyncio.sleep(0.01)
        assert len(asyncio.all_tasks() - before) < len(running - before)
        await served.rest.start()
        async with served.client() as web:
            assert (await web.get("robot")).status_code == 200
    assert asyncio.all_tasks() == before


async def test_a_path_that_is_taken_and_a_robot_without_a_site_are_one_sentence(served: Served) -> None:
    around = Surroundings(served.door, served.scene.station.events.say, site=served.http.mounts)
    url = read_url(ADAPTER.default, ADAPTER.schemes)
    second = ADAPTER.make(around, url)
    with pytest.raises(BridgeError, match="The path /api of the web site is taken"):
        await second.start()
    await second.stop()
    async with served.client() as web:
        assert (await web.get("robot")).status_code == 200
    with pytest.raises(BridgeError, match="needs the robot's web site"):
        RestGateway(Surroundings(served.door, served.scene.station.events.say), url)


async def test_everybody_may_what_the_url_says_and_an_event_says_so(scene: Scene) -> None:
    async with serving(scene, "?role=drive", gate=Gate()) as served:
        assert any("may drive by REST without a key" in text for text in scene.events())
        async with served.client(Client_Id="me") as web:
            await drive(served, web)
            assert (await web.put("settings/follow_link", json={"value": "on"})).status_code == 403
    async with serving(scene, "?role=watch", gate=Gate()) as served, served.client() as web:
        assert (await web.get("robot")).status_code == 200
        assert (await web.post("control")).status_code == 403
    with contextlib.suppress(ValueError):
        read_url(f"{ADAPTER.default}?role=manage", ADAPTER.schemes)
        pytest.fail("Nobody manages a robot without a key.")


async def test_the_application_is_built_beside_the_loop(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A robot is driven meanwhile."""
    threads = []

    def build(*parts: Any) -> Any:
        threads.append(threading.current_thread())
        return application(*parts)

    monkeypatch.setattr(gateway, "application", build)
    async with serving(scene) as served, served.client() as web:
        assert (await web.get("time")).status_code == 200
    assert len(threads) == 1
    assert threads[0] is not threading.current_thread()


async def test_a_body_that_is_packed_is_refused(served: Served) -> None:
    async with served.client() as web:
        packed = await web.post("places", json={"name": "A"}, headers={"Content-Encoding": "gzip"})
        assert (packed.status_code, packed.headers["Accept-Encoding"]) == (415, "identity")
        plain = await web.post("places", json={"name": "A"}, headers={"Content-Encoding": "Identity"})
        assert plain.status_code == 200
