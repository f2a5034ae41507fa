"""Two handhelds at one robot: control goes from one to the other, and a task outlives the phone that started it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from bench.support.child import Child
from bench.support.pair import PHONE, app
from bridge.core.codes import Code
from examples.demo.robot import RobotProcess
from tests.e2e.handheld import PATIENCE, Handheld, handheld


class Other:
    """Another handheld, which is a process of its own."""

    def __init__(self, process: Child) -> None:
        self._process = process

    def ask(self, do: str, **fields: object) -> Any:
        answer = self._process.ask({"do": do, **fields})
        assert "fault" not in answer, answer
        return answer

    def until(self, what: str, value: str) -> None:
        end = time.monotonic() + PATIENCE
        while (known := self.ask("knows")[what]) != value:
            assert time.monotonic() < end, f"{what} is {known}, not {value}"
            time.sleep(0.05)

    def kill(self) -> None:
        self._process.process.kill()
        self._process.process.wait()


@contextmanager
def other(robot: RobotProcess, settings: Path) -> Iterator[Other]:
    with app("--size", PHONE, "--no-gl", "--settings", str(settings)) as (process, _):
        made = Other(process)
        made.ask("connect", url=robot.url)
        made.until("control", "mine")
        yield made


def controls(glass: Handheld, who: str) -> Callable[[], bool]:
    return lambda: glass.app.session.control == who


def test_control_is_handed_over_on_request_and_comes_back_the_same_way(
    robot: RobotProcess, tmp_path: Path
) -> None:
    with (
        other(robot, tmp_path / "other") as phone,
        handheld(tmp_path / "own", url=robot.url, discover=False) as glass,
    ):
        glass.until(controls(glass, "other"), "the other one to drive")
        glass.ask(
            glass.app.session.take_control,
            lambda: glass.glass.labelled("Withdraw"),
            "that we ask is shown",
        )
        phone.ask("command", name="grant")
        glass.until(controls(glass, "mine"), "control")
        phone.until("control", "other")
        phone.ask("command", name="request")
        glass.tap("Hand over")
        glass.until(controls(glass, "other"), "the other one to drive again")
        phone.until("control", "mine")


def test_a_task_outlives_the_phone_that_started_it_and_the_next_one_knows_everything(
    robot: RobotProcess, tmp_path: Path
) -> None:
    with other(robot, tmp_path) as phone:
        phone.ask("hold", seconds=600.0)
        phone.until("task", "RUNNING")
        phone.kill()
    with handheld(tmp_path, url=robot.url, discover=False) as glass:
        session = glass.until(lambda: glass.app.session if glass.app.shell else None, "the robot")
        status = glass.until(lambda: session.feeds.latest("/task/status"), "the task")
        assert (status.task, status.state) == ("hold", "RUNNING")
        glass.until(lambda: session.feeds.state("/task/progress") == "live", "its progress")
        glass.until(
            lambda: any(event.code == Code.CONTROL_FREE for event in session.logbook.events),
            "what happened while there was no phone",
        )
        answer = glass.ask(
            session.tasking.ask_history,
            lambda: getattr(session.outcomes.get("history"), "answer", None),
            "the history",
        )
        assert (answer.runs[0].order.task, answer.runs[0].id) == ("hold", status.task_id)
        glass.control()
        session.command("cancel")
        glass.until(lambda: session.feeds.latest("/task/status").state == "CANCELED", "its end")
