"""On a disk that takes its time or is full: what is refused moves nothing and is not said, what moves is not refused."""

from __future__ import annotations

import itertools
from collections.abc import Awaitable
from typing import Any

import pytest

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    Event,
    Mission,
    Place,
    RunTaskGoal,
    ScheduledTask,
    SetMissionRequest,
    SetModeRequest,
    SetOptionRequest,
    SetPlaceRequest,
    SetQueueRequest,
    SetScheduleRequest,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from robotside.services.command_service import CommandService
from robotside.services.task_actions import goal_service
from tests.fakes import FakeClient
from tests.robotside.slow import FULL, Slow

STRAIGHT = TaskOrder(task="follow_heading", heading=0.0)
SQUARE = [Waypoint(4.0, 0.0), Waypoint(4.0, 3.0), Waypoint(-2.0, 3.0)]

_numbers = itertools.count()


async def done(slow: Slow, answer: Msg | Awaitable[Msg], problem: str = "") -> CommandResponse:
    slow.write(problem)
    answer = answer if isinstance(answer, Msg) else await answer
    assert isinstance(answer, CommandResponse)
    return answer


async def ask(slow: Slow, name: str, request: Msg, problem: str = "") -> CommandResponse:
    return await done(slow, slow.ask(name, request), problem)


def sent(kind: Any = CommandRequest, **words: Any) -> Any:
    """A request as a handheld sends it, with an id of its own."""
    return kind(command_id=f"c{next(_numbers)}", **words)


def moves(slow: Slow) -> bool:
    before = slow.robot.pose
    slow.run(1.5)
    return slow.robot.pose != before


@pytest.fixture
async def slow() -> Slow:
    slow = Slow()
    mission = Mission(waypoints=SQUARE, home=[Waypoint(-3.0, 0.0)])
    assert (await ask(slow, "/mission/set", SetMissionRequest(mission=mission))).success
    return slow


@pytest.mark.parametrize("how", ["start", "home", "resume", "auto", "goal", "bare"])
@pytest.mark.parametrize("manual", [False, True])
async def test_on_a_full_disk_a_task_begins_and_its_answer_says_what_is_not_kept(
    slow: Slow, how: str, manual: bool
) -> None:
    if how in ("resume", "auto"):
        assert (await ask(slow, "/task/start", StartTaskRequest())).success
        assert (await ask(slow, "/task/pause", CommandRequest())).success
    if manual:
        assert (await ask(slow, "/mode/set", SetModeRequest(mode="MANUAL"))).success
    orders = {
        "start": lambda: slow.ask("/task/start", sent(StartTaskRequest)),
        "bare": lambda: slow.ask("/task/start", StartTaskRequest()),
        "home": lambda: slow.ask("/task/go_home", sent()),
        "resume": lambda: slow.ask("/task/resume", sent()),
        "auto": lambda: slow.ask("/mode/set", sent(SetModeRequest, mode="AUTO")),
        "goal": lambda: goal_service(slow.station, CommandService(slow.station)).call(
            FakeClient("anna", slow.clock), sent(RunTaskGoal)
        ),  # type: ignore[arg-type]
    }
    answer = await done(slow, orders[how](), FULL)
    assert answer.success
    assert moves(slow)
    assert slow.station.agenda.manual.by == ""
    if how not in ("resume", "auto") or manual:
        assert answer.message.endswith(f"This could not be saved and would be lost on restart. {FULL}")


async def test_a_start_that_waits_too_long_for_the_disk_is_not_refused_either(
    slow: Slow, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.services.command_service.DISK_TIMEOUT", 0.0)
    answer = slow.ask("/task/start", sent(StartTaskRequest))
    assert not isinstance(answer, Msg)
    said = (await answer).message  # type: ignore[attr-defined]
    assert said.startswith(
        "Patrol started: 3 points, loop. This could not be saved and would be lost on restart. The database has"
    )
    assert moves(slow)


@pytest.mark.parametrize("order", ["pause", "cancel"])
async def test_what_holds_or_ends_a_task_is_not_refused_on_a_full_disk(slow: Slow, order: str) -> None:
    await ask(slow, "/task/start", StartTaskRequest())
    assert (await ask(slow, f"/task/{order}", sent(), FULL)).success
    assert not slow.station.autonomy.engine.running


async def test_manual_is_so_whatever_the_disk_says(slow: Slow) -> None:
    answer = await ask(slow, "/mode/set", sent(SetModeRequest, mode="MANUAL"), FULL)
    assert answer.success
    assert answer.message.endswith(FULL)
    assert slow.station.agenda.manual.by == "a client at 192.0.2.1:5000"


async def test_a_queue_sets_nothing_off_before_it_is_kept_and_never_when_it_is_refused(slow: Slow) -> None:
    answer = slow.ask("/task/queue/set", SetQueueRequest(orders=[STRAIGHT]))
    assert not moves(slow), "it is not on the disk"
    assert (await done(slow, answer, FULL)).message == FULL
    assert not moves(slow)
    assert slow.station.autonomy.engine.status.state == "IDLE"
    answer = slow.ask("/task/queue/set", SetQueueRequest(orders=[STRAIGHT]))
    slow.run(1.5)
    assert (await done(slow, answer)).message == "1 task waits in the queue; it begins now."
    slow.run(1.5)
    assert moves(slow)


async def test_a_scheduled_task_that_is_refused_is_not_begun_meanwhile(slow: Slow) -> None:
    task = ScheduledTask(order=STRAIGHT, every=60.0)
    answer = slow.ask("/schedule/set", SetScheduleRequest(task=task))
    slow.clock += 70.0
    slow.run(3.0)
    assert slow.station.autonomy.engine.status.state == "IDLE"
    assert not (await done(slow, answer, FULL)).success
    slow.run(3.0)
    assert slow.station.autonomy.engine.status.state == "IDLE"


async def test_a_queue_whose_clearing_was_refused_goes_on_waiting(slow: Slow) -> None:
    await ask(slow, "/mode/set", SetModeRequest(mode="MANUAL"))
    await ask(slow, "/task/queue/set", SetQueueRequest(orders=[STRAIGHT]))
    revision = slow.last("/task/queue").revision
    slow.station.agenda.manual.end()
    held = slow.station.agenda.held
    assert held
    assert not (await ask(slow, "/task/queue/set", SetQueueRequest(revision=revision), FULL)).success
    assert slow.station.agenda.held == held
    assert not moves(slow)


async def test_a_queue_that_was_stored_after_its_answer_waits(
    slow: Slow, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("robotside.services.command_service.DISK_TIMEOUT", 0.0)
    answer = slow.ask("/task/queue/set", SetQueueRequest(orders=[STRAIGHT]))
    assert not isinstance(answer, Msg)
    assert not (await answer).success  # type: ignore[attr-defined]
    slow.write()
    assert not moves(slow)
    assert slow.station.agenda.held == "it was stored too late"


@pytest.mark.parametrize(
    ("service", "request_"),
    [
        ("/settings/set", SetOptionRequest(name="follow_link", value="off")),
        ("/places/set", SetPlaceRequest(place=Place(name="Lab", x=1.0, y=1.0))),
        ("/mission/set", SetMissionRequest(mission=Mission())),
        ("/task/queue/set", SetQueueRequest(orders=[STRAIGHT])),
        ("/schedule/set", SetScheduleRequest(task=ScheduledTask(order=STRAIGHT, every=60.0))),
    ],
)
async def test_nobody_is_told_of_what_was_refused(slow: Slow, service: str, request_: Msg) -> None:
    await ask(slow, "/control/acquire", CommandRequest())
    slow.run(0.1)
    slow.write()
    heard: list[Event] = []
    slow.station.bus.subscribe("/events", lambda _, msg: heard.append(msg))  # type: ignore[arg-type]
    heard.clear()  # the last one is told to who comes later
    assert (await ask(slow, service, request_, FULL)).message == FULL
    slow.run(1.5)
    slow.write(FULL)
    assert {event.kind for event in heard} == {"database"}
