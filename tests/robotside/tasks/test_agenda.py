"""Queue and schedule on a whole station, in virtual time: never two tasks at once, never one while something is against it."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    DeleteScheduleRequest,
    GetHistoryRequest,
    Schedule,
    ScheduledTask,
    SetModeRequest,
    SetQueueRequest,
    SetScheduleRequest,
    StartTaskRequest,
    TaskOrder,
    TaskQueue,
    Waypoint,
)
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene


def point(x: float, y: float) -> TaskOrder:
    return TaskOrder(task="go_to", goals=[Waypoint(x, y)])


HOLD = TaskOrder(task="hold", duration=20.0)


def queue(scene: Scene) -> TaskQueue:
    last = scene.station.bus.last("/task/queue")
    assert isinstance(last, TaskQueue)
    return last


def schedule(scene: Scene) -> Schedule:
    last = scene.station.bus.last("/schedule")
    assert isinstance(last, Schedule)
    return last


def fill(scene: Scene, *orders: TaskOrder) -> str:
    answer = scene.ask(
        "/task/queue/set", SetQueueRequest(revision=queue(scene).revision, orders=list(orders))
    )
    assert answer.success, answer.message
    return answer.message


def plan(scene: Scene, order: TaskOrder, **words: object) -> int:
    request = SetScheduleRequest(task=ScheduledTask(order=order, **words))  # type: ignore[arg-type]
    answer = scene.ask("/schedule/set", request)
    assert answer.success, answer.message
    return answer.id  # type: ignore[attr-defined, no-any-return]


def begun(scene: Scene) -> list[str]:
    runs = scene.ask("/history/get", GetHistoryRequest(limit=50)).runs  # type: ignore[attr-defined]
    return [run.order.task for run in reversed(runs)]


def test_the_queue_is_done_in_its_order_one_after_the_other(scene: Scene) -> None:
    assert (
        fill(scene, point(2.0, 0.0), HOLD, point(2.0, 2.0))
        == "3 tasks wait in the queue; the first one begins now."
    )
    scene.run(1.0)
    assert scene.task.state == "RUNNING"
    assert [order.task for order in queue(scene).orders] == ["hold", "go_to"]
    scene.until(lambda: not queue(scene).orders and scene.task.state == "SUCCEEDED", 60.0)
    assert begun(scene) == ["go_to", "hold", "go_to"]
    assert scene.task.state == "SUCCEEDED"
    assert math.hypot(scene.robot.pose[0] - 2.0, scene.robot.pose[1] - 2.0) < 0.2
    assert queue(scene).orders == []


def test_the_queue_can_be_edited_while_a_task_runs(scene: Scene) -> None:
    fill(scene, HOLD, point(2.0, 0.0), point(2.0, 2.0))
    scene.run(1.0)
    before = queue(scene)
    fill(scene, before.orders[1], before.orders[0], HOLD)
    after = queue(scene)
    assert [order.id for order in after.orders[:2]] == [before.orders[1].id, before.orders[0].id]
    assert after.revision > before.revision
    scene.run(21.0)
    assert queue(scene).orders == after.orders[1:]


def test_an_edit_of_a_queue_that_has_changed_meanwhile_is_refused(scene: Scene) -> None:
    fill(scene, HOLD, point(2.0, 0.0), point(2.0, 2.0))
    old = queue(scene)
    scene.run(1.0)
    said = scene.refused("/task/queue/set", SetQueueRequest(revision=old.revision, orders=old.orders))
    assert said.startswith("The queue was changed meanwhile")
    assert len(queue(scene).orders) == 2


def test_an_order_that_cannot_be_done_is_not_queued_and_neither_are_too_many(scene: Scene) -> None:
    request = SetQueueRequest(revision=queue(scene).revision, orders=[HOLD, point(99.0, 0.0)])
    said = scene.refused("/task/queue/set", request)
    assert said == "Task 2 of the queue: The goal at (99.0, 0.0) is off the map."
    request = SetQueueRequest(revision=queue(scene).revision, orders=[HOLD] * 101)
    assert "At most 100" in scene.refused("/task/queue/set", request)
    assert queue(scene).orders == []


def test_a_task_of_the_queue_that_fails_or_cannot_be_done_any_more_lets_the_next_one_come(
    scene: Scene,
) -> None:
    straight = TaskOrder(task="follow_heading", heading=0.0)
    scene.set(home=[Waypoint(0.0, 2.0)])
    fill(scene, straight, TaskOrder(task="go_home"), HOLD)
    scene.run(1.0)
    scene.set(home=[])
    scene.until(lambda: begun(scene)[1:] == ["hold"], 60.0)
    assert begun(scene) == ["follow_heading", "hold"]
    said = "The way home of the queue is left out: Home is not set; set it on the map first."
    assert said in scene.events("task")


@pytest.mark.parametrize("how", ["cancel", "fault", "stop", "home", "goal", "stick", "battery"])
def test_the_queue_waits_after_what_an_operator_or_the_battery_ended_and_goes_on_when_told(
    scene: Scene, how: str
) -> None:
    scene.set(home=[Waypoint(-1.0, -1.0)])
    fill(scene, point(6.0, 0.0), point(0.0, 2.0))
    scene.run(2.0)
    if how == "cancel":
        scene.ask("/task/cancel")
    elif how == "stop":
        scene.ask("/stop")
        scene.release_stop()
    elif how == "fault":
        scene.station.autonomy.engine.cancel("The client is gone.")
    elif how == "home":
        scene.ask("/task/go_home")
    elif how == "goal":
        scene.go_to(-1.0, -1.0)
    elif how == "stick":
        scene.drive(Twist.planar(-0.1, 0.0))
    else:
        scene.robot.battery = 0.09
    scene.run(20.0)
    assert begun(scene)[0] == "go_to"
    assert begun(scene)[1:] in ([], ["go_home"], ["go_to"])
    assert scene.robot.at_rest
    assert len(queue(scene).orders) == 1
    scene.robot.battery = 0.8
    scene.run(1.1)
    if how in ("stop", "stick"):
        scene.ask("/task/resume")
    else:
        waits = [said for said in scene.events("task") if said.endswith("until you choose Go on with this.")]
        assert len(waits) == 1
        assert scene.ask("/task/resume").message == "The queue goes on."
    scene.until(lambda: not queue(scene).orders and not scene.station.autonomy.engine.running, 60.0)
    assert math.hypot(scene.robot.pose[0], scene.robot.pose[1] - 2.0) < 0.2


@pytest.mark.parametrize("how", ["cancel", "home", "restart", "manual"])
def test_what_was_parked_stays_so_behind_another_task_until_told(
    scene: Scene, tmp_path: Path, how: str
) -> None:
    scene.set(home=[Waypoint(-1.0, -1.0)])
    scene.ask("/task/start", StartTaskRequest(order=point(2.0, 0.0)))
    fill(scene, point(0.0, 2.0), point(2.0, 2.0))
    scene.run(1.0)
    if how == "home":
        scene.ask("/task/go_home")
        scene.run(2.0)
    elif how == "manual":
        mode(scene, "MANUAL")
    elif how == "restart":
        scene = Scene(FakeRobot(), tmp_path)
        scene.run(4.0)
    scene.ask("/task/cancel")
    started = scene.ask("/task/start", StartTaskRequest(order=TaskOrder(task="hold", duration=5.0))).message
    assert started.endswith("2 tasks from before wait in the queue until resumed."), started
    scene.run(1.0)
    scene.ask("/task/pause")
    scene.ask("/task/resume")
    scene.run(10.0)
    assert begun(scene)[-1] == "hold"
    assert scene.task.state == "SUCCEEDED"
    assert len(queue(scene).orders) == 2
    assert queue(scene).held, "it is shown for as long as it waits"
    assert scene.ask("/task/resume").message == "The queue goes on."
    assert queue(scene).held == ""
    scene.until(lambda: not queue(scene).orders, 60.0)


def test_a_task_that_is_taken_up_from_manual_takes_the_queue_behind_it_along(scene: Scene) -> None:
    scene.ask("/task/start", StartTaskRequest(order=HOLD))
    fill(scene, point(2.0, 0.0))
    scene.run(1.0)
    mode(scene, "MANUAL")
    scene.ask("/task/resume")
    scene.until(lambda: begun(scene) == ["hold", "go_to"], 40.0)


def test_a_task_that_is_taken_up_after_a_crash_does_not_bring_the_queue_along(
    scene: Scene, tmp_path: Path
) -> None:
    scene.ask("/task/start", StartTaskRequest(order=HOLD))
    fill(scene, point(2.0, 0.0))
    scene.run(1.0)
    again = Scene(FakeRobot(), tmp_path)
    again.run(4.0)
    said = "Resumed. 1 task from before waits in the queue until resumed."
    assert again.ask("/task/resume").message == said
    again.run(40.0)
    assert again.task.state == "SUCCEEDED"
    assert len(queue(again).orders) == 1


def test_the_queue_does_not_start_while_stop_is_pressed_nor_by_its_release(scene: Scene) -> None:
    scene.ask("/stop")
    fill(scene, point(2.0, 0.0))
    scene.run(2.0)
    scene.release_stop()
    scene.run(5.0)
    assert scene.robot.commands == [] or scene.robot.at_rest
    assert begun(scene) == []
    assert scene.ask("/task/resume").success
    scene.run(1.0)
    assert begun(scene) == ["go_to"]


def test_a_queue_needs_that_nobody_else_has_control(scene: Scene) -> None:
    scene.ask("/control/acquire", CommandRequest(client_id="t1", client_name="tablet-A"))
    said = scene.refused("/task/queue/set", SetQueueRequest(orders=[HOLD]), scene.client("bert"))
    assert said.startswith("tablet-A has control")


def test_what_is_scheduled_starts_at_its_time_and_every_day_again(scene: Scene) -> None:
    plan(scene, point(2.0, 0.0), at="00:17")  # the clock stands at 00:16:44
    (task,) = schedule(scene).tasks
    assert task.next.seconds == 1020.0
    scene.run(15.0)
    assert begun(scene) == []
    scene.run(2.0)
    assert begun(scene) == ["go_to"]
    assert schedule(scene).tasks[0].next.seconds == 1020.0 + 86400.0
    (run,) = scene.ask("/history/get", GetHistoryRequest(limit=5)).runs  # type: ignore[attr-defined]
    assert run.by == ""


def test_every_so_often_starts_again_and_again(scene: Scene) -> None:
    plan(scene, HOLD, every=60.0)
    scene.run(200.0)
    assert begun(scene) == ["hold"] * 3


def test_what_is_due_while_a_task_runs_waits_for_its_turn(scene: Scene) -> None:
    plan(scene, point(2.0, 0.0), at="00:17")
    scene.ask("/task/start", StartTaskRequest(order=HOLD))
    scene.run(17.0)
    assert [order.task for order in queue(scene).orders] == ["go_to"]
    assert scene.task.task == "hold"
    said = "A way to a place that was due now waits in the queue for its turn."
    assert scene.events("task").count(said) == 1
    scene.run(10.0)
    assert begun(scene) == ["hold", "go_to"]


def test_what_has_not_ended_since_it_was_due_last_is_not_piled_up(scene: Scene) -> None:
    plan(scene, TaskOrder(task="hold", duration=150.0), every=60.0)
    scene.run(130.0)
    assert begun(scene) == ["hold"]
    assert queue(scene).orders == []
    assert "Holding that was due now is skipped: the one before it has not ended." in scene.events("task")


@pytest.mark.parametrize(
    ("what", "why"),
    [
        ("stop", "STOP is pressed"),
        ("pause", "a task is paused"),
        ("stick", "the robot is driven by hand"),
        ("battery", "the battery is at 14%"),
    ],
)
def test_what_is_due_while_something_is_against_it_is_skipped_and_said(
    scene: Scene, what: str, why: str
) -> None:
    plan(scene, point(2.0, 0.0), at="00:17")
    scene.run(15.0)
    if what == "stop":
        scene.ask("/stop")
    elif what == "pause":
        scene.ask("/task/start", StartTaskRequest(order=HOLD))
        scene.ask("/task/pause")
    elif what == "battery":
        scene.robot.battery = 0.14
        scene.run(1.1)
    for _ in range(15):
        if what == "stick":
            scene.drive(Twist.planar(0.05, 0.0))
        scene.run(0.2)
    said = f"A way to a place that was due now is skipped: {why}."
    assert scene.events("task").count(said) == 1
    assert "go_to" not in begun(scene)
    assert queue(scene).orders == []


def mode(scene: Scene, word: str) -> str:
    answer = scene.ask("/mode/set", SetModeRequest(mode=word, client_name="Anna"))
    assert answer.success, answer.message
    return answer.message


def test_nothing_starts_by_itself_while_the_mode_was_set_to_manual(scene: Scene, tmp_path: Path) -> None:
    plan(scene, point(2.0, 0.0), at="00:17")
    assert mode(scene, "MANUAL") == "The robot is driven by hand; nothing starts by itself."
    told = "Anna set the mode to MANUAL: nothing starts by itself until it is AUTO."
    assert told in scene.events("control")
    said = fill(scene, HOLD)
    assert said == "1 task waits in the queue; it waits, since Anna set the mode to MANUAL."
    scene.run(17.0)
    skipped = "A way to a place that was due now is skipped: Anna set the mode to MANUAL."
    assert scene.events("task").count(skipped) == 1
    again = Scene(FakeRobot(), tmp_path)
    again.ask("/task/queue/set", SetQueueRequest(revision=queue(again).revision))
    fill(again, HOLD)
    again.run(5.0)
    assert begun(again) == [], "a restart is no reason to start"
    assert mode(again, "AUTO") == "The robot drives itself."
    again.run(2.0)
    assert begun(again) == ["hold"]


def test_auto_lets_the_schedule_start_again_and_so_does_a_task_that_somebody_starts(scene: Scene) -> None:
    plan(scene, HOLD, every=60.0)
    mode(scene, "MANUAL")
    assert mode(scene, "AUTO") == "The robot may start scheduled and queued tasks by itself."
    scene.run(61.0)
    assert begun(scene) == ["hold"]
    mode(scene, "MANUAL")
    scene.run(61.0)
    assert begun(scene) == ["hold"]
    scene.ask("/task/cancel")
    scene.ask("/task/start", StartTaskRequest(order=point(1.0, 0.0)))
    scene.run(61.0)
    assert begun(scene) == ["hold", "go_to", "hold"]


def test_what_was_due_while_the_computer_was_off_is_skipped_and_said(scene: Scene, tmp_path: Path) -> None:
    plan(scene, HOLD, at="00:17")
    again = Scene(FakeRobot(), tmp_path)
    again.clock = 1300.0
    again.run(1.0)
    assert begun(again) == []
    assert again.events("task") == [
        (
            "Holding that was due at 1970-01-01 at 00:17 is skipped: "
            "the robot's computer was off or its clock was changed."
        )
    ]


def test_a_scheduled_task_is_changed_switched_off_and_forgotten(scene: Scene) -> None:
    number = plan(scene, HOLD, at="00:17")
    said = scene.ask(
        "/schedule/set", SetScheduleRequest(task=ScheduledTask(number, enabled=False, order=HOLD, at="00:18"))
    ).message
    assert said == "Holding is scheduled, it is switched off."
    scene.run(100.0)
    assert begun(scene) == []
    assert scene.ask("/schedule/delete", DeleteScheduleRequest(id=number)).success
    assert schedule(scene).tasks == []
    said = scene.refused("/schedule/delete", DeleteScheduleRequest(id=number))
    assert said == f"There is no scheduled task with the number {number}."


def test_a_schedule_that_makes_no_sense_is_refused(scene: Scene) -> None:
    request = SetScheduleRequest(task=ScheduledTask(order=HOLD, at="25:00"))
    assert "written as 00:00 to 23:59" in scene.refused("/schedule/set", request)
    request = SetScheduleRequest(task=ScheduledTask(order=TaskOrder(task="dance"), at="10:00"))
    assert "There is no task 'dance'" in scene.refused("/schedule/set", request)
    request = SetScheduleRequest(task=ScheduledTask(7, order=HOLD, at="10:00"))
    assert scene.refused("/schedule/set", request) == "There is no scheduled task with the number 7."


def test_two_that_are_due_together_are_done_one_after_the_other(scene: Scene) -> None:
    scene.set(*SQUARE[:1], laps=1)
    plan(scene, HOLD, at="00:17")
    plan(scene, TaskOrder(task="patrol"), at="00:17")
    scene.run(18.0)
    assert begun(scene) == ["hold"]
    assert [order.task for order in queue(scene).orders] == ["patrol"]
    scene.run(22.0)
    assert begun(scene) == ["hold", "patrol"]


def test_what_brings_it_to_the_charger_starts_with_a_low_battery(scene: Scene) -> None:
    scene.set(home=[Waypoint(2.0, 0.0)])
    plan(scene, TaskOrder(task="go_home"), at="00:17")
    scene.robot.battery = 0.09
    scene.run(18.0)
    assert begun(scene) == ["go_home"]


def test_the_next_start_is_told_by_the_operators_clock_though_the_computers_was_set(tmp_path: Path) -> None:
    set_forward = 0.0
    scene = Scene(FakeRobot(), tmp_path, civil=lambda: 1000.0 + set_forward)
    set_forward = 3600.0
    number = plan(scene, HOLD, every=60.0)
    assert scene.station.records.schedule.all()[0].next.seconds == 4660.0, "by the computer's, as it starts"
    assert schedule(scene).tasks[0].id == number
    assert schedule(scene).tasks[0].next.seconds == pytest.approx(1060.0)
