"""Work for idle frames: its order, its budget, when it waits and when it ends; and that it makes ready what a robot needs."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from kivy.base import EventLoop

from app.idle_work import BUDGET, MAX_WAIT, METHODS, SOON, IdleWork, get_ready, imports
from tests.headless import Stage

ROOT = Path(__file__).parents[2]


class Desk:
    """Steps that take as long as they say, on a clock of their own."""

    def __init__(self, stage: Stage) -> None:
        self.stage, self.time, self.may = stage, 0.0, True
        self.done: list[str] = []
        self.frames: list[list[str]] = []
        self.work: IdleWork | None = None

    def step(self, name: str, takes: float) -> Callable[[], None]:
        def step() -> None:
            self.time += takes
            self.done.append(name)

        return step

    def make(self, *steps: Callable[[], object]) -> IdleWork:
        self.stage.frames(2)  # what others left to be drawn
        self.work = IdleWork(steps, may=lambda: self.may, spent=lambda: self.time)
        return self.work

    def begin(self, *steps: Callable[[], object]) -> IdleWork:
        work = self.make(*steps)
        self.flip()
        return work

    def flip(self) -> None:
        """A frame comes onto the glass."""
        self.stage.window.dispatch("on_flip")

    def frame(self) -> list[str]:
        """What one frame does of it."""
        before = len(self.done)
        self.stage.frames(1)
        return self.done[before:]


@pytest.fixture
def desk(stage: Stage) -> Iterator[Desk]:
    desk = Desk(stage)
    yield desk
    if desk.work is not None:
        desk.work.close()


def test_nothing_is_done_before_the_first_frame_is_on_the_glass(desk: Desk) -> None:
    desk.make(desk.step("a", 0.001))
    for _ in range(3):
        assert desk.frame() == []
    desk.flip()
    assert desk.done == []
    assert desk.frame() == ["a"]


def test_where_nothing_is_drawn_it_is_not_waited_for_for_good(desk: Desk) -> None:
    desk.make(desk.step("a", 0.001))
    for _ in range(MAX_WAIT):
        assert desk.frame() == []
    assert desk.frame() == ["a"]


def test_a_frame_takes_steps_in_their_order_until_its_time_is_spent(desk: Desk) -> None:
    half = BUDGET / 2
    desk.begin(*(desk.step(name, half) for name in "abcde"))
    assert desk.frame() == ["a", "b"]
    assert desk.frame() == ["c", "d"]
    assert desk.frame() == ["e"]


def test_a_long_step_has_a_frame_of_its_own(desk: Desk) -> None:
    desk.begin(desk.step("long", 10 * BUDGET), desk.step("next", 0.001))
    assert desk.frame() == ["long"]
    assert desk.frame() == ["next"]


def test_while_a_hand_is_at_work_nothing_is_done(desk: Desk) -> None:
    desk.begin(desk.step("a", BUDGET), desk.step("b", BUDGET))
    assert desk.frame() == ["a"]
    desk.may = False
    for _ in range(5):
        assert desk.frame() == []
    desk.may = True
    assert desk.frame() == ["b"]


def test_once_closed_it_does_nothing_more(desk: Desk) -> None:
    work = desk.begin(desk.step("a", BUDGET), desk.step("b", BUDGET))
    desk.frame()
    work.close()
    assert work.left == 0
    assert desk.frame() == []
    assert desk.done == ["a"]


def test_once_closed_it_asks_no_more_frames_of_the_window(desk: Desk) -> None:
    asked = desk.stage.window.get_property_observers
    before = len(asked("on_flip"))
    work = desk.make(desk.step("a", BUDGET))
    assert len(asked("on_flip")) == before + 1
    work.close()
    assert len(asked("on_flip")) == before


def test_a_step_that_fails_is_logged_and_the_next_is_taken(desk: Desk, caplog: Any) -> None:
    desk.begin(lambda: 1 / 0, desk.step("next", 0.001))
    desk.frame()
    assert desk.done == ["next"]
    assert "ZeroDivisionError" in caplog.text


def test_when_all_is_done_no_frame_is_asked_any_more(desk: Desk) -> None:
    asked: list[bool] = []
    desk.stage.frames(2)
    work = IdleWork([], may=lambda: asked.append(True) or True, spent=lambda: 0.0)
    desk.flip()
    desk.frame()
    assert asked == [True]
    desk.stage.frames(3)
    assert asked == [True]
    work.close()


def test_a_module_that_is_left_out_of_the_build_is_passed_over(desk: Desk, caplog: Any) -> None:
    desk.begin(*imports(["app.study.no_such_module"]), desk.step("next", 0.001))
    desk.frame()
    assert desk.done == ["next"]
    assert caplog.text == ""


READY = """
import sys
from tests.headless import prepare
prepare("logic")
import app.application
from app.idle_work import imports
for step in imports(app.idle_work.SOON):
    step()
before = set(sys.modules)
from app.screens import robot_screens
import app.session.session, app.link.link, app.stop.stop_lane, app.screens.mission.mission, app.screens.drive.drive
print(sorted(set(sys.modules) - before))
"""


def test_afterwards_a_robot_needs_no_module_that_is_not_imported() -> None:
    told = subprocess.run([sys.executable, "-c", READY], cwd=ROOT, capture_output=True, text=True, check=True)
    assert told.stdout.splitlines()[-1] == "[]"


def test_each_module_is_named_once() -> None:
    assert len({*METHODS, *SOON}) == len(METHODS) + len(SOON)


def test_a_finger_keeps_it_waiting_and_a_mouse_that_only_hovers_does_not(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[str] = []
    methods = SimpleNamespace(open_rest=lambda: opened.append("methods"))
    app: Any = SimpleNamespace(methods=methods, collector=SimpleNamespace(keep=lambda: None), session=None)
    there = [SimpleNamespace(is_touch=True)]
    monkeypatch.setattr(EventLoop, "me_list", there)
    work = get_ready(app)
    try:
        stage.frames(MAX_WAIT + 20)
        assert opened == []
        there[:] = [SimpleNamespace(is_touch=False)]
        stage.frames(60)
        assert opened == ["methods"]
    finally:
        work.close()
