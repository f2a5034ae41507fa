"""What is done through the door is found in the audit log, and what is not worth a row fills none."""

from __future__ import annotations

from pathlib import Path

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role, public_id
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    PairScanRequest,
    PairScanResponse,
    Place,
    SetModeRequest,
    SetOptionRequest,
    SetPlaceRequest,
)
from robotside.core.config import DEFAULT_CONFIG
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.records.audit import Audit, Entry
from robotside.records.database.audit_rows import Audited
from robotside.services import audit_trail
from robotside.services.audit_trail import PARAMETERS, PUBLISHED, READ_ONLY, AuditTrail
from robotside.trust.permissions import PERMISSIONS
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.door.test_gate import GATE
from tests.robotside.scene import Scene
from tests.robotside.slow import FULL, Slow

SECRET = "tablet-7-secret"
ANNA = Identity("id-7", "Anna", Role.DRIVE, proven=True)


@pytest.fixture
def scene(tmp_path: Path) -> Scene:
    return Scene(FakeRobot(), tmp_path, config=DEFAULT_CONFIG)


def rows(scene: Scene) -> list[Audited]:
    return [row for row in scene.station.records.audit.rows() if row.operation != "control"]


def told(scene: Scene) -> list[tuple[str, str]]:
    return [(row.operation, row.outcome) for row in rows(scene)]


def anna(scene: Scene) -> FakeClient:
    client = FakeClient("a", scene.clock, ANNA)
    client.way = "rosbridge"
    return client


def test_a_command_is_recorded_with_who_did_it_by_which_way_in(scene: Scene) -> None:
    scene.ask("/mode/set", SetModeRequest(mode="MANUAL", client_id=SECRET), anna(scene))
    (row,) = rows(scene)
    assert (row.operation, row.outcome, row.parameters) == ("call /mode/set", "done", "mode=MANUAL")
    assert (row.person_id, row.name, row.role, row.way) == ("id-7", "Anna", "drive", "rosbridge")
    assert row.address == "192.0.2.1"
    assert row.stamp == round(scene.clock * 1e9)


def test_who_proved_nothing_is_called_so_and_its_secret_is_not_kept(scene: Scene) -> None:
    scene.ask("/stop", CommandRequest(client_id=SECRET, client_name="Ben"), FakeClient("b", scene.clock))
    (row,) = rows(scene)
    assert (row.name, row.person_id) == ("Ben (not proven)", public_id(SECRET))
    assert not any(SECRET in str(value) for each in rows(scene) for value in each.__rich_repr__())


def test_a_refused_command_has_its_code(scene: Scene) -> None:
    scene.refused("/task/cancel")
    ((operation, outcome),) = told(scene)
    assert operation == "call /task/cancel"
    assert outcome.startswith("refused ")
    assert outcome != "refused failed"


def test_reading_is_not_recorded(scene: Scene) -> None:
    for operation in READ_ONLY:
        name = operation.removeprefix("call ")
        if name in scene.door.services:
            scene.door.call(scene.anna, name, scene.door.services[name].request())
    assert rows(scene) == []


def test_a_command_that_is_sent_again_is_one_row(scene: Scene) -> None:
    for _ in range(3):
        scene.ask("/mode/set", SetModeRequest(mode="MANUAL", command_id="1"))
    assert len(rows(scene)) == 1


def test_a_place_is_recorded_without_where_it_is_and_how_it_is_called(scene: Scene) -> None:
    scene.ask("/places/set", SetPlaceRequest(place=Place(name="Bed of Ben", x=1.25, y=7.5)))
    (row,) = rows(scene)
    assert row.operation == "call /places/set"
    assert row.parameters == ""


def test_a_goal_is_recorded_and_driving_as_who_has_control(scene: Scene) -> None:
    scene.go_to(1.0, 0.0)
    assert ("publish /goal_pose", "done") in told(scene)
    for _ in range(50):
        scene.drive(Twist(linear=Vector3(0.2)))
        scene.run(0.1)
    found = [row for row in scene.station.records.audit.rows() if row.operation == "control"]
    assert len(found) <= 2
    scene.ask("/control/acquire", CommandRequest(client_id=SECRET, client_name="Anna"))
    found = [row for row in scene.station.records.audit.rows() if row.operation == "control"]
    assert (found[-1].outcome, found[-1].name) == ("taken", "Anna (not proven)")
    assert SECRET not in {row.person_id for row in found}


def test_who_floods_the_door_is_counted_and_fills_no_log(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [0.0]
    audit = scene.station.records.audit
    trail = AuditTrail(audit, lambda: 1000.0, lambda: now[0])
    stranger = FakeClient("s", 0.0, Identity("", "", Role.NONE))
    for number in range(1000):
        trail.refused(stranger, f"call /nothing/{number}", Refused("No."))
        trail.unknown("192.0.2.66:7", "http", Refused("No."))
    assert len(audit.rows()) <= audit_trail.MAX_EACH + 2
    now[0] = audit_trail.REPEAT_PERIOD + 1.0
    trail.did(scene.anna, "page /audit.csv")
    assert any(row.outcome.endswith("999 times more") for row in audit.rows())
    assert audit.verify() is None


def test_many_strangers_at_many_addresses_push_nothing_out_of_the_log(scene: Scene) -> None:
    now = [0.0]
    audit = scene.station.records.audit
    trail = AuditTrail(audit, lambda: 1000.0, lambda: now[0])
    for number in range(3000):
        stranger = FakeClient("s", 0.0, Identity("", "", Role.NONE))
        stranger.address = f"192.0.2.{number % 250}:7"
        trail.refused(stranger, f"call /nothing/{number % 7}", Refused("No."))
        trail.refused(stranger, f"subscribe /nothing/{number}", Refused("No."))
    assert len(audit.rows()) <= audit_trail.MAX_REPEATED + 2
    assert {row.operation for row in audit.rows() if row.name == audit_trail.SEVERAL} == {"call", "subscribe"}
    now[0] = audit_trail.REPEAT_PERIOD + 1.0
    trail.did(scene.anna, "page /audit.csv")
    counted = sum(
        int(row.outcome.split(", ")[1].split()[0]) for row in audit.rows() if "times more" in row.outcome
    )
    first = sum("times more" not in row.outcome and row.outcome.startswith("refused") for row in audit.rows())
    assert counted + first == 6000


def test_what_a_stranger_is_refused_at_the_door_and_a_wrong_key_are_recorded(scene: Scene) -> None:
    door = StationDoor(scene.station, GATE)
    stranger = door.join("192.0.2.9:1", way="rosbridge")
    with pytest.raises(Refused):
        door.call(stranger, "/task/start", CommandRequest())
    with pytest.raises(Refused):
        door.join("192.0.2.9:1", way="http", token="wrong")
    with pytest.raises(Refused):
        door.authenticate(stranger, "wrong")
    door.authenticate(stranger, "d")
    door.join("192.0.2.9:2", way="mqtt", token="m")
    found = [(row.operation, row.outcome, row.name, row.way) for row in rows(scene)]
    assert ("call /task/start", "refused trust_unknown", "", "rosbridge") in found
    assert ("auth", "refused refused", "", "http") in found
    assert ("auth", "done", "Person d", "rosbridge") in found
    assert ("auth", "done", "Person m", "mqtt") in found


async def test_stop_without_a_session_is_recorded(scene: Scene) -> None:
    stranger, known = Operator("1", "192.0.2.9:1", 0.0, way="http"), anna(scene)
    known.way = "http"
    await scene.door.stop(stranger, "Ben")
    await scene.door.stop(known, "Another person")
    assert scene.station.controls.stopped_by == "Ben at 192.0.2.9 (not proven)"
    assert [
        (row.operation, row.outcome, row.person_id, row.name, row.role, row.way, row.address)
        for row in rows(scene)
    ] == [
        ("stop", "done", "", "Ben (not proven)", "none", "http", "192.0.2.9"),
        ("stop", "done", "id-7", "Anna", "drive", "http", "192.0.2.1"),
    ]


async def test_stop_stops_though_the_audit_log_is_broken(
    scene: Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise RuntimeError("broken")

    monkeypatch.setattr(Audit, "_record", fail)
    assert scene.ask("/stop").success
    assert scene.station.controls.stopped


async def test_what_came_to_nothing_on_a_full_disk_is_recorded_as_that() -> None:
    slow = Slow()
    answer = slow.ask("/places/set", SetPlaceRequest(place=Place(name="Lab")))
    slow.write(FULL)
    assert not isinstance(answer, Msg)
    assert not (await answer).success  # type: ignore[attr-defined]
    waiting = [
        row for row in slow.records._ledger.rows("audit").values() if row.operation == "call /places/set"
    ]
    assert [row.outcome for row in waiting] == ["done", "refused records_unwritten"]


def test_only_known_services_have_parameters_and_none_names_anybody() -> None:
    assert {f"call {name}" for name in PARAMETERS} - {"call /task/run"} <= set(PERMISSIONS)
    assert all(f"publish {topic}" in PERMISSIONS for topic in PUBLISHED)
    for fields in PARAMETERS.values():
        assert not {"client_name", "client_id", "token", "secret", "x", "y"} & set(fields)


def test_settings_are_recorded_with_their_value(scene: Scene) -> None:
    scene.ask("/settings/set", SetOptionRequest(name="follow_link", value="off"))
    assert rows(scene)[0].parameters == "name=follow_link value=off"


def test_an_entry_that_is_long_is_cut() -> None:
    from robotside.records import Records

    records = Records.in_memory()
    records.audit.record(Entry("x" * 1000), 1.0)
    assert len(records.audit.rows()[0].operation) == 200


async def test_who_was_paired_is_recorded_without_the_key(scene: Scene) -> None:
    async def scan(client: Operator, asked: PairScanRequest) -> PairScanResponse:
        if asked.secret != "right":
            raise Refused(Notice(Code.TRUST_UNKNOWN, "No."))
        return PairScanResponse("id-9", "id-9.verysecret", "drive")

    service = Service("/pair/scan", "pilothouse_msgs/PairScan", PairScanRequest, PairScanResponse, scan)
    door = StationDoor(scene.station, services=[service])
    stranger = door.join("192.0.2.9:1", way="rosbridge")
    with pytest.raises(Refused):
        await door.call(stranger, "/pair/scan", PairScanRequest(secret="wrong", name="Ben"))  # type: ignore[misc]
    await door.call(stranger, "/pair/scan", PairScanRequest(secret="right", name="Ben"))  # type: ignore[misc]
    assert [(row.outcome, row.parameters) for row in rows(scene)] == [
        ("refused trust_unknown", ""),
        ("done", "id=id-9 role=drive"),
    ]
    assert not any("verysecret" in str(row) or "Ben" in str(row) for row in rows(scene))
