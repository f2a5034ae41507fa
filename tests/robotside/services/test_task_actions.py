"""Tasks as goals of an action, in virtual time; and over a real socket."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from bridge.core.errors import Refused
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    Mission,
    RunTaskFeedback,
    RunTaskGoal,
    RunTaskResult,
    StartTaskRequest,
    TaskOrder,
)
from robotside.core.pose2 import ORIGIN
from tests.bridge.wires import Record
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.scene import SQUARE, Scene
from tests.robotside.serving.test_station_server import connected, serving


class Goal:
    """A goal under way."""

    def __init__(self, scene: Scene, client: FakeClient | None = None, **words: Any) -> None:
        self.told: list[Msg] = []
        goal = RunTaskGoal(**words)
        self.work = asyncio.ensure_future(
            scene.door.run(client or scene.anna, "/task/run", goal, self.told.append)
        )

    async def begun(self) -> Goal:
        await asyncio.sleep(0)
        return self

    async def refused(self) -> str:
        with pytest.raises(Refused) as caught:
            await self.work
        return str(caught.value)


async def test_a_goal_is_a_task_with_its_progress_and_its_end(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    goal = await Goal(scene, client_name="tablet").begun()
    assert scene.task.state == "RUNNING"
    assert scene.control.driver == "tablet"
    scene.run_task()
    result = await goal.work
    assert result == RunTaskResult(scene.task.task_id, "SUCCEEDED", "Patrol done: 3 points visited.", 3)
    assert len(goal.told) > 10
    assert all(isinstance(told, RunTaskFeedback) for told in goal.told)
    assert goal.told == sorted(goal.told, key=lambda told: told.distance_driven)  # type: ignore[attr-defined]


async def test_going_home_is_one_too(scene: Scene) -> None:
    scene.set(*SQUARE)
    goal = await Goal(scene, task="go_home").begun()
    scene.run_task()
    assert (await goal.work).message == "Home."  # type: ignore[attr-defined]


async def test_a_goal_is_refused_with_the_words_of_the_service(scene: Scene) -> None:
    assert await Goal(scene).refused() == scene.refused("/task/start", StartTaskRequest())
    assert (await Goal(scene, task="dance").refused()).startswith(
        "There is no task 'dance'; there are patrol, "
    )
    assert scene.ask("/control/acquire").success
    assert "has control" in await Goal(scene, scene.client("ben")).refused()
    scene.ask("/stop")
    assert await Goal(scene).refused() == "STOP is pressed; hold Release to drive again."


@pytest.mark.parametrize("task", ["patrol", "go_home"])
async def test_a_second_goal_is_refused_while_one_runs(scene: Scene, task: str) -> None:
    scene.set(*SQUARE)
    first = await Goal(scene).begun()
    assert await Goal(scene, task=task).refused() == "A task is running already; stop it first."
    assert not first.work.done()
    scene.ask("/task/cancel")
    await first.refused()


async def test_a_goal_that_is_taken_back_ends_the_task(scene: Scene) -> None:
    scene.set(*SQUARE)
    goal = await Goal(scene, client_name="tablet").begun()
    scene.run(2.0)
    goal.work.cancel()
    with pytest.raises(asyncio.CancelledError):
        await goal.work
    assert (scene.task.state, scene.task.reason) == ("CANCELED", "Canceled by tablet.")
    assert scene.robot.at_rest


async def test_a_goal_that_is_taken_back_as_it_ends_leaves_the_task_that_came_after_it(scene: Scene) -> None:
    scene.set(*SQUARE)
    goal = await Goal(scene).begun()
    scene.ask("/task/cancel")
    scene.start()
    goal.work.cancel()
    with pytest.raises(asyncio.CancelledError):
        await goal.work
    assert (scene.task.state, scene.task.task_id) == ("RUNNING", 2)


async def test_a_goal_that_somebody_else_has_taken_over_is_left_to_them(scene: Scene) -> None:
    scene.set(*SQUARE)
    goal = await Goal(scene).begun()
    scene.station.controls.release(scene.anna)
    ben = scene.client("ben")
    scene.ask("/control/acquire", CommandRequest(client_name="Ben"), ben)
    goal.work.cancel()
    assert "Ben has control" in await goal.refused()
    assert scene.task.state == "RUNNING"


@pytest.mark.parametrize("order", ["/task/cancel", "/task/go_home"])
async def test_a_task_that_others_end_is_told_with_its_reason(scene: Scene, order: str) -> None:
    scene.set(*SQUARE)
    goal = await Goal(scene).begun()
    scene.run(1.0)
    scene.ask(order)
    said = {"/task/cancel": "Canceled by", "/task/go_home": "Patrol ended: way home was requested instead."}
    assert (await goal.refused()).startswith(said[order])


async def test_nothing_of_a_goal_is_left_on_the_bus(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    goal = await Goal(scene).begun()
    scene.run_task()
    await goal.work
    before = len(goal.told)
    scene.start()
    scene.run(3.0)
    assert len(goal.told) == before


async def test_a_client_hears_how_far_its_task_is_and_takes_it_back(tmp_path: Path) -> None:
    robot = FakeRobot()
    async with serving(tmp_path, robot) as serves, connected(serves) as client:
        station, told = serves.station, Record()
        with pytest.raises(Refused, match="'s position is unknown"):
            await client.goal("/task/run", RunTaskGoal()).result(5.0)
        station.autonomy.place(ORIGIN)
        station.missions.store(Mission(waypoints=SQUARE))
        goal = client.goal("/task/run", RunTaskGoal(client_name="script"), on_feedback=told)
        feedback = (await told.reach(1))[0]
        assert isinstance(feedback, RunTaskFeedback)
        assert goal.cancel()
        with pytest.raises(Refused):
            await goal.result(5.0)
        assert station.autonomy.engine.status.reason == "Canceled by script."


async def test_a_goal_ends_with_its_client(tmp_path: Path) -> None:
    robot, over = FakeRobot(), Record()
    async with serving(tmp_path, robot) as serves:
        station = serves.station
        station.autonomy.place(ORIGIN)
        station.missions.store(Mission(waypoints=SQUARE))
        station.bus.subscribe("/task/status", lambda _, msg: over(msg.state))  # type: ignore[attr-defined]
        async with connected(serves) as client:
            client.goal("/task/run", RunTaskGoal(client_name="script"))
            await over.until(lambda states: "RUNNING" in states)
        await over.until(lambda states: "CANCELED" in states)
        assert station.autonomy.engine.status.reason == "Canceled: script, who started it, is gone."
        assert robot.at_rest


async def test_a_goal_may_be_any_order(scene: Scene) -> None:
    goal = await Goal(scene, order=TaskOrder(task="hold", duration=2.0)).begun()
    scene.run_task()
    assert (await goal.work).message == "Held for 2 s."  # type: ignore[attr-defined]
