"""The SOAP gateway on a station: STOP first, then what is refused, who may do what, and orders between named places."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import AsyncIterator

import pytest

from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import ArmState, Event, TagRead
from robotside.gateways.adapter import Surroundings
from robotside.gateways.discovery import read_wish
from robotside.gateways.plain.strict_json import MAX_INPUT
from robotside.gateways.soap.fields import NS, SOAP
from tests.robotside.gateways.soap.served import ROBOT, TYPE, Answer, Served, body, message, serving
from tests.robotside.scene import Scene

STOP = message(body("Stop"))
AHEAD = '{"linear": {"x": 0.2}}'


@pytest.fixture
async def served(scene: Scene) -> AsyncIterator[Served]:
    async with serving(scene) as made:
        yield made


STOPS = {
    "as it should be": STOP.encode(),
    "nothing": b"",
    "no XML": b"stop!",
    "unknown fields": message(body("Stop", surprise=1)).encode(),
    "another operation": message(body("GetPose")).encode(),
    "a document type": b"<!DOCTYPE x><x/>",
    "too long": b"x" * (MAX_INPUT + 1),
    "not UTF-8": b"\xff\xfe",
}


TOKENS = ("", "wrong", "watch", "drive")
UNTOLD = (body("Stop"), body("Stop", surprise=1), f"{body('Stop')}{body('GetPose')}")


def moving(served: Served) -> None:
    """STOP is not pressed, and the robot moves."""
    served.scene.station.controls.release_stop()
    served.scene.robot.drive(Twist.planar(0.3, 0.0))


async def test_anybody_stops_the_robot_whatever_the_message_says(served: Served) -> None:
    for (what, raw), token in itertools.product(STOPS.items(), TOKENS):
        moving(served)
        answer = await served.post(raw, token=token, action="Stop", kind="image/png")
        assert (answer.status, answer.value("message")) == (200, "Stopped."), (what, token)
        assert served.stopped, (what, token)
        assert served.scene.robot.at_rest, (what, token)


async def test_a_stop_that_no_header_tells_of_is_pressed_too(served: Served) -> None:
    for inner, token, kind in itertools.product(UNTOLD, TOKENS, (TYPE, "text/plain")):
        moving(served)
        answer = await served.post(message(inner), token=token, kind=kind)
        assert (answer.status, answer.value("message")) == (200, "Stopped."), (inner, token)
        assert served.stopped, (inner, token)
        assert served.scene.robot.at_rest, (inner, token)


async def test_stop_waits_for_no_body_that_does_not_come(served: Served) -> None:
    async def never() -> AsyncIterator[bytes]:
        yield b"<"
        await asyncio.get_running_loop().create_future()

    moving(served)
    async with asyncio.timeout(20):
        answer = await served.post(never(), token="", action="Stop")
    assert answer.value("message") == "Stopped."
    assert served.scene.robot.at_rest


async def test_a_page_of_the_world_presses_stop_only(served: Served) -> None:
    evil = {"Origin": "https://evil.example"}
    answer = await served.post(message(body("GoHome")), action="GoHome", **evil)
    assert answer.status == 403
    assert answer.fault[0] == "Client"
    assert (await served.post(STOP, token="", action="Stop", **evil)).status == 200
    assert served.stopped


async def test_who_pressed_stop_is_named_as_it_calls_itself(served: Served) -> None:
    await served.ask("Stop", {"clientName": "Fred"}, token="")
    assert served.scene.control.stopped_by == "Fred"


async def test_what_says_stop_in_its_header_does_nothing_else(served: Served) -> None:
    await served.post(message(body("GoTo", place="Lab")), token="drive", action="Stop")
    assert served.stopped
    assert served.scene.task.state == "IDLE"


BOMB = "<!DOCTYPE b [<!ENTITY a 'ha'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;'>]>" + message(
    body("GoTo", place="Lab")
)
FOREIGN = "<!DOCTYPE x [<!ENTITY e SYSTEM 'file:///etc/hostname'>]>" + message(
    f'<GoTo xmlns="{NS}"><place>&e;</place></GoTo>'
)
BAD = {
    "an XML bomb": (BOMB, "no document type"),
    "an entity from elsewhere": (FOREIGN, "no document type"),
    "a document type in another encoding": (b'<?xml version="1.0" encoding="UTF-7"?>' + b"+ADwAIQ-DOCTYPE x+AD4-<x/>", "not XML"),
    "UTF-16": (message(body("GetInfo")).encode("utf-16"), "UTF-8"),
    "no XML": ("hello", "The message is not XML"),
    "no envelope": ("<hello/>", "Envelope of SOAP 1.1, not 'hello'"),
    "an unknown operation": (message(body("Fly")), "There is no operation 'Fly'"),
    "an answer as a question": (message(body("GetPoseResponse", stamp=1.0, sure="true")), "There is no operation 'GetPoseResponse'"),
    "no operation": (message(""), "one Body with one element"),
    "two operations": (message(body("GetPose") + body("GoHome")), "one Body with one element"),
    "an unknown field": (message(body("GoTo", place="Lab", hurry="true")), "hurry"),
    "a missing field": (message(body("GoTo")), "place"),
    "a field twice": (message(body("GoTo", place=["Lab", "Lab"])), "place"),
    "an empty name": (message(body("GoTo", place="")), "place"),
    "a word for a number": (message(body("StartTask", task="hold", speed="fast")), "'fast'"),
    "not a number": (message(body("StartTask", task="hold", speed="NaN")), "'NaN'"),
    "infinity": (message(body("StartTask", task="hold", speed="INF")), "'INF'"),
    "too large a number": (message(body("StartTask", task="hold", speed="1e999")), "'1e999'"),
    "out of range": (message(body("StartTask", task="hold", speed="-1")), "'-1'"),
    "a number for a truth": (message(body("GoTo", place="Lab", instead="2")), "'2'"),
    "an unknown header field": (message(body("GoHome"), mood="good"), "mood"),
    "a stamp that is none": (message(body("GoHome"), stamp="NaN"), "'NaN'"),
    "an unknown message field": (
        message(body("PublishMessage", topic="/goal_pose", message='{"pose": {"position": {"h": 1}}}')),
        "pose.position.h",
    ),
    "a message that is no JSON": (message(body("PublishMessage", topic="/goal_pose", message="{")), "not JSON"),
    "a request with another type": (message(body("CallService", service="/task/start", message='{"order": {"task": 5}}')), "task"),
    "an unknown service": (message(body("CallService", service="/nowhere")), "does not carry"),
    "an unknown topic": (message(body("GetMessage", topic="/nowhere")), "no topic '/nowhere'"),
}  # fmt: skip


async def test_what_is_wrong_is_a_fault_that_says_so_and_moves_nothing(served: Served) -> None:
    wrong = {}
    for what, (raw, said) in BAD.items():
        answer = await served.post(raw)
        who, sentence, _ = answer.fault
        if (answer.status, who) != (500, "Client") or said not in sentence or "/etc" in answer.text:
            wrong[what] = answer
    assert not wrong
    assert served.scene.task.state == "IDLE"
    assert served.scene.robot.at_rest


async def test_a_message_that_says_that_it_is_not_utf_8_is_refused(served: Served) -> None:
    raw = '<?xml version="1.0" encoding="ISO-8859-1"?>' + message(body("GoTo", place="Café"))
    assert "UTF-8" in (await served.post(raw.encode())).fault[1]


async def test_a_comment_in_a_value_hides_no_part_of_it(served: Served) -> None:
    raw = message(f'<GoTo xmlns="{NS}"><place>La<!-- x -->b</place></GoTo>')
    assert (await served.post(raw)).value("message") == "Way to Lab started."


async def test_other_types_versions_and_lengths_are_refused(served: Served) -> None:
    asked = message(body("GetInfo"))
    assert "text/xml" in (await served.post(asked, kind="application/json")).fault[1]
    assert (await served.post(asked, kind="application/json")).status == 415
    assert "UTF-8" in (await served.post(asked, kind="text/xml; charset=utf-16")).fault[1]
    twelve = asked.replace(SOAP, "http://www.w3.org/2003/05/soap-envelope")
    assert (await served.post(twelve)).fault[0] == "VersionMismatch"
    long = await served.post(message(body("GoTo", place="x" * MAX_INPUT)))
    assert (long.status, str(MAX_INPUT) in long.fault[1]) == (413, True)
    must = asked.replace(
        "<s:Body>", '<s:Header><x:Tx xmlns:x="urn:x" s:mustUnderstand="1"/></s:Header><s:Body>'
    )
    assert (await served.post(must)).fault[0] == "MustUnderstand"
    assert (await served.post(must.replace('"1"', '"0"'))).value("name") == "Fake-1"


async def test_strangers_are_known_by_no_token_and_a_wrong_one_is_refused_as_a_fault(served: Served) -> None:
    for token in ("", "wrong"):
        answer = await served.ask("GetInfo", token=token)
        assert (answer.status, answer.fault[0]) == (401, "Client")
    async with served.client() as web:
        assert (await web.get("/soap?wsdl")).status_code == 401


async def test_who_watches_reads_and_drives_nothing(served: Served) -> None:
    assert (await served.ask("GetInfo", token="watch")).value("name") == "Fake-1"
    for operation, fields in (
        ("GoTo", {"place": "Lab"}),
        ("Pause", {}),
        ("CallService", {"service": "/control/acquire"}),
    ):
        assert (await served.ask(operation, token="watch", **fields)).fault[2] == Code.TRUST_ROLE.value
    drive = await served.ask(
        "PublishMessage", {"clientId": "a"}, token="watch", topic="/cmd_vel", message=AHEAD
    )
    assert drive.fault[2] == Code.TRUST_ROLE.value
    callback = await served.ask("Subscribe", token="watch", topic="/events", callback="http://192.0.2.7:1/")
    assert callback.fault[2] == Code.TRUST_ROLE.value
    assert served.scene.robot.at_rest


async def test_a_role_for_everybody_is_told_of(scene: Scene) -> None:
    async with serving(scene, "soap=?role=drive") as served:
        assert (await served.ask("GoTo", token="", place="Lab")).value("message")
    assert Code.GATEWAY_OPEN.value in [msg.code for _, msg in scene.said if isinstance(msg, Event)]


async def test_a_delivery_between_places_by_their_names(served: Served) -> None:
    fault = (await served.ask("Deliver", source="Office 12", target="Moon")).fault
    assert fault[1:] == ("There is no place 'Moon'; there are Office 12, Lab.", Code.PLACE_UNKNOWN.value)
    answer = await served.ask("Deliver", source="office 12", target="Lab", item="coffee")
    assert answer.value("message") == "Delivery started."
    scene = served.scene
    assert (scene.task.task, scene.task.places) == ("deliver", ["Office 12", "Lab"])
    scene.until(lambda: bool(scene.task.asks), 60.0)
    assert (await served.ask("GetStatus")).value("asks") == "Has it been picked up at Office 12?"
    assert (await served.ask("Confirm")).value("message") == "Confirmed."
    scene.run(0.2)
    scene.until(lambda: bool(scene.task.asks), 60.0)
    assert (await served.ask("Confirm")).value("message") == "Confirmed."
    assert scene.run_task().reason == "Delivered at Lab."


async def test_tasks_are_held_and_ended(served: Served) -> None:
    assert (await served.ask("GuideTo", place=["Office 12", "Lab"], message="This way")).value("message")
    assert (await served.ask("Pause")).value("message") == "Paused."
    assert (await served.ask("GetStatus")).value("state") == "PAUSED"
    assert (await served.ask("Resume")).value("message") == "Resumed."
    assert (await served.ask("GoTo", place="Lab")).fault[2] == Code.TASK_ACTIVE.value
    assert (await served.ask("GoTo", place="Lab", instead="true")).value("message")
    assert (await served.ask("Cancel")).value("message") == "Canceled."
    assert (await served.ask("Cancel")).fault[2] == Code.TASK_NONE_RUNNING.value
    assert "home" in (await served.ask("GoHome")).fault[1].lower()
    assert "no service" in (await served.ask("MoveArm", pose="home")).fault[1]


async def test_nothing_begins_while_stop_is_pressed(served: Served) -> None:
    await served.ask("Stop")
    for operation, fields in (("GoTo", {"place": "Lab"}), ("StartTask", {"task": "hold"}), ("Resume", {})):
        assert (await served.ask(operation, **fields)).fault[2] == Code.STOP_IS_PRESSED.value
    assert served.scene.robot.at_rest


async def test_a_repeated_command_is_done_once_and_an_old_one_not_at_all(served: Served) -> None:
    sent = {"clientId": "tablet", "commandId": "c1"}
    first = await served.ask("GoTo", sent, place="Lab")
    assert (await served.ask("GoTo", sent, place="Lab")).text == first.text
    assert len([event for event in served.scene.events("task") if "started" in event]) <= 1
    old = {"stamp": served.scene.clock - 6.0}
    assert (await served.ask("Cancel", old)).fault[2] == Code.COMMAND_LATE.value
    assert served.scene.task.state == "RUNNING"


async def test_a_client_with_an_id_keeps_control_between_its_calls_and_gives_it_back(served: Served) -> None:
    me = {"clientId": "a", "clientName": "Anna"}
    assert (await served.ask("CallService", me, service="/control/acquire")).value("message")
    assert served.scene.control.driver == "Drive"  # by its token, whatever it calls itself
    other = await served.ask("GoTo", {"clientId": "b"}, place="Lab")
    assert other.fault[2] == Code.CONTROL_HELD_ELSEWHERE.value
    await served.ask("Leave", me)
    assert not served.scene.control.driver
    await served.ask("CallService", service="/control/acquire")
    assert not served.scene.control.driver  # who has no id is gone once it is answered


async def test_of_payloads_that_the_url_leaves_out_no_answer_tells(scene: Scene) -> None:
    scene.station.bus.publish("/arm", ArmState(joints=["a"], angles=[0.0], poses=["home"]))
    for wish, told in (("soap", True), ("soap=site:/soap?payloads=camera", False)):
        async with serving(scene, wish) as served:
            if told:
                assert (await served.ask("GoTo", {"clientId": "a"}, place="Lab")).status == 200
            status = await served.ask("GetStatus", {"clientId": "a"})
            info = await served.ask("GetInfo", {"clientId": "a"})
            assert bool(status.value("task")) == told
            assert (status.value("positionSure") == "true") == told
            assert bool(info.value("armPose")) == told


async def drive(served: Served, caller: dict[str, object], host: str = "192.0.2.7") -> Answer:
    asked = message(body("PublishMessage", topic="/cmd_vel", message=AHEAD), **caller)
    return await served.post(asked, host=host)


async def test_a_drive_command_of_nobody_or_of_unknown_or_too_great_age_moves_nothing(served: Served) -> None:
    now = served.scene.clock
    assert "clientId" in (await drive(served, {"stamp": now})).fault[1]
    await drive(served, {"clientId": "a", "stamp": now}, "192.0.2.8")  # of a clock that was never compared
    for host, stamp in (("192.0.2.9", {}), ("192.0.2.10", {"stamp": now - 1.0})):
        time = await served.post(message(body("GetTime"), clientId="a"), host=host)
        assert float(time.value("stamp") or 0) == pytest.approx(served.scene.clock)
        await drive(served, {"clientId": "a", **stamp}, host)
        served.scene.run(0.05)
    assert served.scene.robot.at_rest
    assert not any(served.scene.robot.commands)


async def test_what_the_robot_does_not_obey_is_a_fault(served: Served) -> None:
    scene, me = served.scene, {"clientId": "a"}
    await served.ask("GetTime", me)
    await drive(served, me | {"stamp": scene.clock})
    await served.ask("Stop")
    scene.run(0.05)
    assert (await drive(served, me | {"stamp": scene.clock})).fault[2] == Code.STOP_IS_PRESSED
    assert scene.robot.at_rest


@pytest.mark.parametrize("ending", ["Leave", "time", "the gateway's end"])
async def test_it_drives_by_a_fresh_stamp_and_rests_when_it_ends(served: Served, ending: str) -> None:
    scene, me = served.scene, {"clientId": "a"}
    await served.ask("GetTime", me)
    await drive(served, me | {"stamp": scene.clock})
    assert not scene.robot.at_rest
    if ending == "Leave":
        await served.ask("Leave", me)
    elif ending == "time":
        scene.run(0.4)
    else:
        await served.gateway.stop()
    assert scene.robot.at_rest


async def test_it_is_answered_what_the_robot_says(served: Served) -> None:
    served.scene.run(1.0)
    assert [place.text for place in (await served.ask("ListPlaces")).top.iter(f"{{{NS}}}name")] == [
        "Office 12",
        "Lab",
    ]
    pose = await served.ask("GetPose")
    assert abs(float(pose.value("x") or "nan")) < 0.1
    assert pose.value("sure") in ("true", "false")
    told = await served.ask("GetMessage", topic="/battery_state")
    assert told.value("type") == "sensor_msgs/BatteryState"
    assert '"percentage":0.8' in (told.value("message") or "")
    assert "no message" in (await served.ask("GetMessage", topic="/tag")).fault[1]
    waiting = asyncio.create_task(served.ask("GetMessage", topic="/tag", patience=10))
    while not (served.door._subscriptions or waiting.done()):  # noqa: ASYNC110 - what is waited for is no event
        await asyncio.sleep(0)
    served.scene.robot.more.append(("/tag", TagRead(tag="card-12")))
    served.scene.run(0.1)
    assert "card-12" in ((await waiting).value("message") or "")
    answer = await served.ask("CallService", service="/history/get", message='{"limit": 1}')
    assert "runs" in (answer.value("message") or "")


async def test_what_the_url_leaves_out_is_not_carried(scene: Scene) -> None:
    async with serving(scene, "soap=?payloads=arm") as served:
        for operation, fields in (
            ("GoTo", {"place": "Lab"}), ("GetPose", {}), ("Subscribe", {"topic": "/odom"}), ("GetMessage", {"topic": "/odom"})
        ):  # fmt: skip
            assert (await served.ask(operation, **fields)).fault[2] == Code.GATEWAY_LEFT_OUT.value
        assert (await served.ask("Stop")).value("message") == "Stopped."


async def test_the_contract_names_the_address_that_was_asked(served: Served) -> None:
    async with served.client() as web:
        shown = {"Authorization": "Bearer watch"}
        for query, there in (("wsdl", f"{ROBOT}/soap"), ("subscriber.wsdl", f"{ROBOT}/soap")):
            told = await web.get(f"/soap?{query}", headers=shown)
            assert told.headers["content-type"] == TYPE
            assert f'location="{there}"' in told.text
        assert (await web.get("/soap?other", headers=shown)).status_code == 404
        assert (await web.get("/soap/other", headers=shown)).status_code == 404
        assert (await web.put("/soap", headers=shown)).status_code == 405
        odd = await web.get("/soap?wsdl", headers=shown | {"Host": 'a"<b'})
        assert "<b" not in odd.text.partition("location")[2][:50]
        guide = (await web.get("/soap", headers=shown)).text
    assert guide.strip() == (await served.ask("GetGuide")).value("text")


async def test_a_fault_of_the_program_is_the_servers_and_ends_nothing(
    served: Served, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object) -> None:
        raise RuntimeError("broken")

    monkeypatch.setattr(served.gateway._services, "do", broken)
    assert (await served.ask("GetInfo")).fault[:2] == (
        "Server",
        "The robot failed at GetInfo; its log says why.",
    )
    monkeypatch.undo()
    assert (await served.ask("GetInfo")).status == 200


async def test_it_comes_and_goes_with_nothing_left(scene: Scene) -> None:
    before = asyncio.all_tasks()
    for _ in range(2):
        async with serving(scene) as served:
            assert (await served.ask("GetInfo", {"clientId": "a"})).status == 200
            await served.ask("Subscribe", topic="/odom")
            driven = served.door
        assert not driven._operators
        assert not driven._subscriptions
    assert asyncio.all_tasks() == before
    adapter, url = read_wish("soap")
    with pytest.raises(BridgeError, match="web site"):
        adapter.make(Surroundings(scene.door, scene.station.events.say), url)


async def test_a_message_that_is_packed_is_refused_and_a_stop_is_heard(served: Served) -> None:
    answer = await served.post(message(body("GetInfo")), **{"Content-Encoding": "gzip"})
    assert (answer.status, "as it is, not 'gzip'" in answer.fault[1]) == (415, True)
    assert (await served.post(message(body("GetInfo")), **{"Content-Encoding": "identity"})).status == 200
    assert (await served.post(STOP, **{"Content-Encoding": "gzip"})).status == 200
    assert served.stopped
