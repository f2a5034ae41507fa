"""Resources by REST: what is refused, with which status, and that nothing is done then; and what each does."""

from __future__ import annotations

import asyncio
import html
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import httpx
import pytest

from bridge.msgs.pilothouse_msgs import ArmState
from robotside.gateways.plain.strict_json import MAX_INPUT
from robotside.gateways.rest import desk
from tests.robotside.gateways.http.test_doorkeeper import Gate
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.rest.served import Served, serving
from tests.robotside.scene import Scene

JSON = {"Content-Type": "application/json"}
PLACE = {"name": "Office 12", "x": 1.0, "y": 2.0}


def equipped(state: Path) -> Scene:
    scene = Scene(EquippedRobot(), state)
    scene.run(1.0)
    scene.station.bus.publish("/arm", ArmState())
    return scene


@pytest.fixture
async def served(tmp_path: Path) -> AsyncIterator[Served]:
    async with serving(equipped(tmp_path)) as served:
        yield served


async def refused(answer: httpx.Response, status: int, said: str, code: str = "") -> None:
    body = answer.json()
    assert answer.status_code == status, body
    assert (body["success"], body["code"]) == (False, code)
    assert said in body["message"]
    assert body["message"].endswith((".", "?"))


WRONG = {
    "unknown field": (422, b'{"nam": "A"}', 'no field "place.nam"; did you mean place.name?'),
    "unknown field within": (422, b'{"name": "A", "x": 1, "z": 2}', 'no field "place.z"'),
    "text for a number": (422, b'{"name": "A", "x": "1"}', 'x must be a number or null, not "1"'),
    "truth for a number": (422, b'{"name": "A", "x": true}', "x must be a number or null, not true"),
    "NaN": (422, b'{"name": "A", "x": NaN}', "not JSON"),
    "Infinity": (422, b'{"name": "A", "x": Infinity}', "not JSON"),
    "1e999": (422, b'{"name": "A", "x": 1e999}', "not JSON"),
    "a number for a text": (422, b'{"name": 1}', "name must be a text, not 1"),
    "a list": (422, b"[1]", "must be an object"),
    "a text": (422, b'"A"', "must be an object"),
    "half": (422, b'{"name": "A"', "not JSON"),
    "no UTF-8": (422, b'{"name": "\xff"}', "not JSON"),
    "deep": (422, b'{"name": ' + b"[" * 5000 + b"]" * 5000 + b"}", "."),
    "too long": (413, b'{"name": "' + b"x" * MAX_INPUT + b'"}', "at most 65536 bytes"),
}


async def test_a_wrong_body_is_refused_with_what_is_wrong_and_nothing_is_done(served: Served) -> None:
    async with served.client() as web:
        for status, raw, said in WRONG.values():
            await refused(await web.post("places", content=raw, headers=JSON), status, said)
        assert (await web.get("places")).json()["places"] == []


async def test_a_body_of_another_form_is_refused(served: Served) -> None:
    async with served.client() as web:
        for kind in (
            "",
            "text/plain",
            "application/x-www-form-urlencoded",
            "multipart/form-data; boundary=x",
        ):
            named = {"Content-Type": kind} if kind else {}
            answer = await web.post("places", content=b'{"name": "A"}', headers=named)
            await refused(answer, 415, f"by its Content-Type, not {kind.partition(';')[0]!r}")
            assert answer.headers["accept"] == "application/json, application/xml"
        assert (await web.get("places")).json()["places"] == []


async def test_a_body_that_does_not_say_how_long_it_is_has_the_same_limit(served: Served) -> None:
    async def pieces() -> AsyncIterator[bytes]:
        for _ in range(20):
            yield b" " * 8192

    async with served.client() as web:
        answer = await web.post("places", content=pieces(), headers=JSON)
        assert answer.status_code == 413


ABSENT = [
    ("GET", "nowhere", 404, "no such path"),
    ("GET", "places/7", 404, "none with the id 7"),
    ("GET", "places/x", 422, "id: "),
    ("GET", "places/-1", 422, "id: "),
    ("GET", "places/99999999999", 422, "id: "),
    ("DELETE", "places/7", 404, "."),
    ("PATCH", "places", 405, "PATCH is not done here"),
    ("GET", "events?since=x", 422, "since: "),
    ("GET", "events?sinc=1", 422, "no parameter 'sinc' here; it has since, most, boot"),
    ("GET", "events?since=1&since=2", 422, "since is given twice"),
    ("GET", "places?x=1", 422, "it has none"),
    ("GET", "topics/nowhere", 404, "no topic '/nowhere'"),
    ("GET", "topics/camera/image/compressed", 404, "no topic"),
    ("POST", "topics/nowhere", 404, "no topic"),
    ("POST", "topics/odom", 405, "speaks on /odom"),
    ("GET", "topics/cmd_vel", 405, "publish there by POST"),
    ("GET", "topics/odom/stream?rate=0", 422, "rate: "),
    ("GET", "topics/odom/stream?rate=51", 422, "rate: "),
    ("GET", "topics/odom/stream?rate=nan", 422, "rate: "),
    ("POST", "services/nowhere", 404, "no service '/nowhere'"),
    ("POST", "services/rosapi/topics", 404, "no service"),
    ("GET", "payloads/claw", 404, "no payload 'claw'"),
    ("GET", "people", 404, "no service '/people/list'"),
]


async def test_what_is_not_there_is_said(served: Served) -> None:
    async with served.client() as web:
        for method, path, status, said in ABSENT:
            answer = await web.request(method, path)
            await refused(answer, status, said, answer.json()["code"])
            assert (status == 405) is ("allow" in answer.headers)


async def test_an_answer_in_no_form_that_there_is_does_nothing(served: Served) -> None:
    async with served.client(Accept="image/png") as web:
        await refused(await web.post("places", json=PLACE), 406, "not as 'image/png'")
        await refused(await web.post("services/places/set", json={"place": PLACE}), 406, "image/png")
        await refused(await web.post("topics/goal_pose", json={}), 406, "image/png")
        assert (await web.get("places", headers={"Accept": "*/*"})).json()["places"] == []


async def test_places_are_made_read_changed_and_deleted_in_json_and_in_xml(served: Served) -> None:
    async with served.client() as web:
        made = (await web.post("places", json=PLACE)).json()
        assert made["success"]
        assert (await web.get(f"places/{made['id']}")).json()["name"] == "Office 12"
        xml = b"<place><name>Office 13</name><x>3.5</x><y>-1</y></place>"
        answer = await web.put(f"places/{made['id']}", content=xml, headers={"Content-Type": "text/xml"})
        assert answer.status_code == 200, answer.text
        text = (await web.get(f"places/{made['id']}", headers={"Accept": "text/plain"})).text
        assert "name: Office 13\n" in text
        assert "x: 3.5\n" in text
        shown = (await web.get("places", headers={"Accept": "text/xml"})).text
        assert "<places><item><id>1</id><name>Office 13</name>" in shown
        await refused(
            await web.put("places/1", json=PLACE | {"id": 2}), 422, "id is 2 in the body and 1 in the path"
        )
        assert (await web.delete("places/1")).status_code == 200
        answer = await web.delete("places/1")
        assert (answer.status_code, answer.json()["code"]) == (404, "place_id_unknown")


DONE: list[tuple[str, str, Any]] = [
    ("PUT", "missions/current", {"waypoints": [{"x": 1.0}], "home": [{"x": 0.0}], "name": "evening"}),
    ("GET", "missions/current", None),
    ("GET", "missions", None),
    ("POST", "missions/evening/recall", None),
    ("POST", "schedule", {"at": "08:00", "order": {"task": "patrol"}}),
    ("GET", "schedule/1", None),
    ("PUT", "schedule/1", {"at": "09:00", "order": {"task": "patrol"}}),
    ("DELETE", "schedule/1", None),
    ("GET", "schedule", None),
    ("PUT", "tasks/queue", {"revision": 0, "orders": []}),
    ("GET", "tasks/queue", None),
    ("GET", "tasks", None),
    ("GET", "tasks/history?limit=5", None),
    ("GET", "events?since=0&most=5", None),
    ("PUT", "payloads/arm", {"order": {"pose": "home"}}),
    ("POST", "payloads/arm", {"order": {"increments": [0.01, 0.0, 0.0, 0.0, 0.0]}}),
    ("GET", "payloads/arm", None),
    ("GET", "payloads", None),
    ("PUT", "payloads/lights", {"brightness": 0.5}),
    ("PUT", "mode", {"mode": "MANUAL"}),
    ("PUT", "settings/follow_link", {"value": "off"}),
    ("GET", "control", None),
    ("GET", "robot", None),
    ("GET", "topics", None),
    ("GET", "topics/odom", None),
    ("GET", "services", None),
    ("GET", "", None),
    ("DELETE", "control", None),
]


async def test_each_resource_does_what_its_service_does(served: Served) -> None:
    async with served.client(Client_Id="me") as web:
        assert (await web.post("control")).json()["success"]
        for method, path, body in DONE:
            answer = await (
                web.request(method, path, json=body) if body is not None else web.request(method, path)
            )
            assert answer.status_code == 200, (method, path, answer.text)
            assert answer.headers["cache-control"] == "no-store"
            assert answer.json().get("success", True)
            assert (await web.get(path.partition("?")[0])).status_code < 500
        assert (await web.get("missions")).json()["names"] == ["evening"]


async def test_a_task_is_refused_for_the_robots_state_and_for_its_values_with_its_code(
    served: Served,
) -> None:
    async with served.client(Client_Id="me") as web:
        for method, path, body, status, code in (
            ("POST", "tasks", {"order": {"task": "go_home"}}, 409, "position_unknown"),
            ("PUT", "missions/current", {"laps": -1}, 422, "laps_invalid"),
            ("POST", "missions/night/recall", {}, 404, "mission_unknown"),
            ("PUT", "mode", {"mode": "FAST"}, 422, "mode_unknown"),
            ("POST", "places", {"name": ""}, 422, "place_unnamed"),
            ("POST", "events/acknowledge", {"ids": [99]}, 404, "event_unknown"),
        ):
            answer = await web.request(method, path, json=body)
            assert (answer.status_code, answer.json()["code"]) == (status, code), answer.text
            assert not answer.json()["success"]
        answer = await web.post("tasks/pause")
        assert (answer.status_code, answer.json()["code"]) == (409, "task_none_running")


async def test_a_topic_that_is_made_on_demand_is_waited_for(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    async with served.client() as web:
        asking = asyncio.create_task(web.get("topics/rosout"))
        async with asyncio.timeout(60):
            while not served.door._subscriptions:  # noqa: ASYNC110 - nothing says when
                await asyncio.sleep(0.01)
        served.scene.station.events.say("control", "Hello.")
        assert (await asking).json()["msg"] == "Hello."
        monkeypatch.setattr(desk, "DEMAND_TIMEOUT", 0.05)
        answer = await web.get("topics/rosout")
        await refused(answer, 503, "no message on /rosout yet")
        assert answer.headers["retry-after"] == "5"
    assert not served.door._subscriptions


ROLES = [
    ("", "GET", "places", 401, "trust_unknown"),
    ("n.key", "GET", "places", 401, "trust_unknown"),
    ("x.key", "GET", "places", 401, ""),
    ("w.key", "GET", "places", 200, ""),
    ("w.key", "POST", "places", 403, "trust_role"),
    ("w.key", "POST", "control", 403, "trust_role"),
    ("w.key", "POST", "services/task/start", 403, "trust_role"),
    ("w.key", "POST", "topics/goal_pose", 403, "trust_role"),
    ("w.key", "PUT", "settings/follow_link", 403, "trust_role"),
    ("m.key", "POST", "places", 422, "place_unnamed"),
]


async def test_a_role_that_is_too_small_and_a_wrong_key_are_refused(tmp_path: Path) -> None:
    async with serving(equipped(tmp_path), gate=Gate()) as served:
        for token, method, path, status, code in ROLES:
            async with served.client(token) as web:
                answer = await web.request(method, path)
            assert answer.status_code == status, answer.text
            if status != 200:
                assert answer.json()["code"] == code
                assert answer.json()["message"].endswith(".")
            assert (status == 401) is ("www-authenticate" in answer.headers)


async def test_only_the_payloads_that_were_chosen_are_carried(tmp_path: Path) -> None:
    async with serving(equipped(tmp_path), "?payloads=arm") as served, served.client() as web:
        assert [each["key"] for each in (await web.get("payloads")).json()["payloads"]] == ["robot", "arm"]
        for path in ("topics/odom", "payloads/wheels", "topics/odom/stream"):
            assert (await web.get(path)).status_code == 404
        assert (await web.post("services/task/start")).status_code == 404
        assert (await web.post("places", json=PLACE)).status_code == 404
        assert (await web.put("payloads/arm", json={"order": {"pose": "home"}})).status_code == 200
        assert (await web.post("stop")).status_code == 200


async def test_the_page_of_paths_loads_nothing_from_anywhere(served: Served) -> None:
    async with served.client() as web:
        answer = await web.get("docs")
        assert answer.headers["content-type"].startswith("text/html")
        assert "default-src 'none'" in answer.headers["content-security-policy"]
        assert not any(
            word in answer.text for word in ('href="http', "<script", "<link", "src=", "url(", "@import")
        )
        for method, path, what in (
            ("GET", "/api/time", "The robot&#x27;s time, by which a client stamps its drive commands."),
            ("PUT", "/api/payloads/arm", "Moves the arm to a pose, a point or angles."),
        ):
            assert (
                f'{method}</span> <code class="name">{path}</code>\n<p class="quiet">{what}</p>'
                in answer.text
            )
        shown = html.unescape(answer.text)
        assert shown.count('<pre>{"order": {"pose": "home"}}</pre>') == 2
        assert '<pre>{"brightness": 1.0}</pre>' in shown
        assert "as for <code>/api/topics/cmd_vel</code>:</p><pre>{" in shown
        assert 'name="viewport" content="width=device-width' in answer.text
        assert "prefers-color-scheme:dark" in answer.text
        page = (await web.get("guide")).text
        assert served.url in page
