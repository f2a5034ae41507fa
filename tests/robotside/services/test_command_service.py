"""Answers that leave when what they say is on the disk."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable
from typing import Any

import pytest

from bridge.msgs import Msg
from bridge.msgs.arrays import Int32Array
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import (
    AcknowledgeEventsRequest,
    CommandRequest,
    Event,
    GetMissionRequest,
    GetMissionsRequest,
    Mission,
    Place,
    PlaceArray,
    SetMissionRequest,
    SetPlaceRequest,
    SetPlaceResponse,
    StartTaskRequest,
    Waypoint,
)
from tests.robotside.slow import FULL, Slow


@pytest.fixture
def slow() -> Slow:
    return Slow()


def place(name: str = "Office 12", command_id: str = "") -> SetPlaceRequest:
    return SetPlaceRequest(command_id=command_id, place=Place(name=name, x=1.0, y=1.0))


async def soon(answer: Msg | Awaitable[Msg]) -> asyncio.Task[Any]:
    assert not isinstance(answer, Msg), "it did not wait for the disk"
    task = asyncio.ensure_future(answer)
    await asyncio.sleep(0)
    assert not task.done()
    return task  # type: ignore[return-value]


async def test_an_answer_and_what_is_shown_wait_for_the_disk(slow: Slow) -> None:
    answer = await soon(slow.ask("/places/set", place()))
    assert slow.last("/places").places == []
    slow.write()
    assert await answer == SetPlaceResponse(True, "Office 12 is saved.", id=1)
    shown = slow.last("/places")
    assert isinstance(shown, PlaceArray)
    assert [each.name for each in shown.places] == ["Office 12"]


async def test_what_cannot_be_written_is_refused_and_not_shown(slow: Slow) -> None:
    mission = SetMissionRequest(mission=Mission(waypoints=[Waypoint(1.0, 1.0)]))
    answer, other = (
        await soon(slow.ask("/mission/set", mission)),
        await soon(slow.ask("/places/set", place())),
    )
    slow.write(FULL)
    assert ((await answer).success, (await answer).message) == (False, FULL)
    assert await other == SetPlaceResponse(False, FULL, code="records_unwritten")
    assert slow.station.missions.current == slow.last("/mission") == Mission()
    assert slow.records.places.all() == []


async def test_an_event_of_what_was_not_stored_is_not_said(slow: Slow) -> None:
    heard: list[Event] = []
    slow.station.bus.subscribe("/events", lambda _, msg: heard.append(msg))  # type: ignore[arg-type]
    answer = await soon(slow.ask("/mission/set", SetMissionRequest(mission=Mission())))
    slow.write(FULL)
    await answer
    assert [event.text for event in heard if event.kind == "mission"] == []


async def test_a_command_that_is_sent_again_waits_with_the_first_one_and_is_done_once(slow: Slow) -> None:
    first = await soon(slow.ask("/places/set", place(command_id="c1")))
    second = await soon(slow.ask("/places/set", place(command_id="c1")))
    slow.write()
    assert await first == await second == SetPlaceResponse(True, "Office 12 is saved.", id=1)
    assert slow.ask("/places/set", place(command_id="c1")) == SetPlaceResponse(
        True, "Office 12 is saved.", id=1
    )


async def test_a_command_that_could_not_be_written_is_told_so_again(slow: Slow) -> None:
    first = await soon(slow.ask("/places/set", place(command_id="c1")))
    slow.write(FULL)
    await first
    assert slow.ask("/places/set", place(command_id="c1")) == SetPlaceResponse(
        False, FULL, code="records_unwritten"
    )


async def test_the_start_of_a_task_is_answered_when_its_run_is_kept_and_stands_if_it_cannot_be(
    slow: Slow,
) -> None:
    answer = slow.ask("/mission/set", SetMissionRequest(mission=Mission(waypoints=[Waypoint(3.0, 0.0)])))
    slow.write()
    assert (await answer).success  # type: ignore[misc, union-attr]
    started = await soon(slow.ask("/task/start", StartTaskRequest()))
    slow.write(FULL)
    assert (await started).success
    assert slow.station.autonomy.engine.running


@pytest.mark.parametrize("service", ["/control/acquire", "/control/release"])
def test_control_never_wait_for_the_disk(slow: Slow, service: str) -> None:
    answer = slow.ask(service, CommandRequest(client_name="Anna"))
    assert isinstance(answer, Msg)
    assert answer.success  # type: ignore[attr-defined]


def test_an_event_is_told_when_it_is_on_the_disk_or_cannot_be(slow: Slow) -> None:
    heard: list[Event] = []
    slow.station.bus.subscribe("/events", lambda _, msg: heard.append(msg))  # type: ignore[arg-type]
    heard.clear()  # the last one is told to who comes later
    slow.station.events.say("task", "One.")
    assert heard == []
    slow.write()
    slow.station.events.say("task", "Two.")
    slow.write(FULL)
    assert [event.text for event in heard] == ["One.", "Two.", FULL]
    known = [event.text for event in slow.station.events.since(1, slow.station.events.boot)]
    assert known[-1] == "One.", "the others are asked for when they are on the disk"
    slow.records.try_again()
    slow.write()
    known = [event.text for event in slow.station.events.since(1, slow.station.events.boot)]
    assert known[-4:] == ["One.", "Two.", FULL, "The database can be written again."]


async def test_an_answer_that_rests_on_what_is_on_its_way_waits_for_it(slow: Slow) -> None:
    slow.station.events.say("task", "One.")
    slow.write()
    number = slow.last("/events").id
    request = AcknowledgeEventsRequest(client_name="Anna", ids=Int32Array([number]))
    first = await soon(slow.ask("/events/acknowledge", request))
    second = await soon(slow.ask("/events/acknowledge", request))
    slow.write()
    assert (await first).message == "1 event acknowledged."
    assert (await second).message == "Already acknowledged."
    third = slow.ask("/events/acknowledge", request)
    assert isinstance(third, Msg), "it is on the disk"


async def test_what_is_told_on_request_is_on_the_disk(slow: Slow) -> None:
    mission = SetMissionRequest(mission=Mission(name="Night"))
    answer = await soon(slow.ask("/mission/set", mission))
    assert slow.ask("/missions/get", GetMissionsRequest()).names == []  # type: ignore[union-attr]
    assert slow.ask("/mission/get", GetMissionRequest()).mission.name == ""  # type: ignore[union-attr]
    slow.write()
    await answer
    assert slow.ask("/missions/get", GetMissionsRequest()).names == ["Night"]  # type: ignore[union-attr]
    assert slow.ask("/mission/get", GetMissionRequest()).mission.name == "Night"  # type: ignore[union-attr]


async def test_the_end_of_a_task_is_answered_when_no_restart_would_offer_it_again(slow: Slow) -> None:
    answer = slow.ask("/mission/set", SetMissionRequest(mission=Mission(waypoints=[Waypoint(3.0, 0.0)])))
    slow.write()
    await answer  # type: ignore[misc]
    started = await soon(slow.ask("/task/start", StartTaskRequest()))
    slow.write()
    assert (await started).success
    canceled = await soon(slow.ask("/task/cancel", CommandRequest()))
    slow.write()
    assert (await canceled).success
    assert slow.records.runs.under_way is None


async def test_a_command_that_is_sent_again_after_a_crash_is_not_done_again(slow: Slow) -> None:
    answer = await soon(slow.ask("/places/set", place(command_id="c1")))
    slow.write()
    await answer  # it is on the disk, and the answer got lost
    slow.restart()
    assert slow.ask("/places/set", place(command_id="c1")) == SetPlaceResponse(
        True, "Office 12 is saved.", id=1
    )
    assert len(slow.records.places.all()) == 1
    other = slow.ask("/places/set", place(command_id="c2"))
    said = "There is a place 'Office 12' already; choose another name."
    taken = [KeyValue("place", "Office 12")]
    assert other == SetPlaceResponse(False, said, code="place_name_taken", parameters=taken)


async def test_a_command_that_was_not_written_is_done_when_it_is_sent_again_after_a_crash(slow: Slow) -> None:
    answer = await soon(slow.ask("/places/set", place(command_id="c1")))
    slow.write(FULL)
    await answer
    slow.restart()
    again = await soon(slow.ask("/places/set", place(command_id="c1")))
    slow.write()
    assert (await again).success


async def test_the_newest_answers_are_kept(slow: Slow, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("robotside.records.answers.MAX_ANSWERS", 2)
    for number in range(4):
        answer = await soon(slow.ask("/places/set", place(f"{number}", f"c{number}")))
        slow.write()
        await answer
    assert [answered.command_id for answered in slow.records.answers.all()] == ["c2", "c3"]
