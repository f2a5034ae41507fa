"""Contacts, tree and mark together, before a glass that is none: what is done, when, and what never is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import pytest

from app.inputs.switch_access.scan.engine import Engine, Selection
from app.inputs.switch_access.scan.plan import Planner
from app.inputs.switch_access.scan.presses import Timing
from app.inputs.switch_access.scan.scan import Pace
from app.inputs.switch_access.scan.target import Mark, Target

TICK = 0.03


class Glass:
    """Buttons that only know their names."""

    def __init__(self, *names: str) -> None:
        self.place = "drive"
        self.done: list[str] = []
        self.marked: Mark | None = None
        self.asked = 0
        self.there = [self.target(name) for name in names]

    def target(self, name: str, words: str = "", *, repeatable: bool = False) -> Target:
        return Target(name, words or name, lambda: self.done.append(name), repeatable=repeatable)

    def targets(self) -> Sequence[Target]:
        self.asked += 1
        return self.there

    def mark(self, mark: Mark | None) -> None:
        self.marked = mark


class Bench:
    """Somebody with two switches before such a glass."""

    def __init__(self, *names: str, pace: Pace | None = None, timing: Timing | None = None) -> None:
        self.glass = Glass(*names)
        self.stops: list[float] = []
        self.chosen: list[Selection] = []
        self.heard: list[str] = []
        self.said: list[tuple[str, bool]] = []
        self.now = 100.0
        self.engine = Engine(self.glass, Planner({}), self, timing, pace)

    def stop(self, began: float) -> None:
        self.stops.append(round(began - 100.0, 2))

    def do(self, chosen: Selection) -> None:
        self.chosen.append(chosen)
        chosen.target.act()

    def stepped(self, sound: str, mark: Mark | None) -> None:
        self.heard.append(sound)

    def stuck(self, switch: str, stuck: bool) -> None:
        self.said.append((switch, stuck))

    def wait(self, seconds: float) -> None:
        for _ in range(math.ceil(seconds / TICK)):
            self.now += TICK
            self.engine.update(self.now)

    def down(self, switch: Literal["A", "B"]) -> None:
        self.engine.press(switch, switch, self.now)

    def up(self, switch: Literal["A", "B"]) -> None:
        self.engine.release(switch, self.now)

    def press(self, switch: Literal["A", "B"], seconds: float = 0.12) -> None:
        self.down(switch)
        self.wait(seconds)
        self.up(switch)
        self.wait(0.3)

    @property
    def marked(self) -> str:
        mark = self.glass.marked
        return "" if mark is None else "+".join(target.name for target in mark.targets)


def test_the_first_press_of_either_only_shows_where_it_begins() -> None:
    for switch in ("A", "B"):
        bench = Bench("a", "b", "c")
        bench.press("A" if switch == "A" else "B")
        assert (bench.marked, bench.glass.done) == ("a", [])


def test_a_steps_at_the_press_and_b_does_it_when_it_is_let_go() -> None:
    bench = Bench("a", "b", "c")
    bench.press("A")
    bench.down("A")
    assert bench.marked == "b"
    bench.up("A")
    bench.wait(0.3)
    bench.down("B")
    bench.wait(0.5)
    assert (bench.glass.done, bench.marked) == ([], "b")
    bench.up("B")
    bench.wait(0.15)
    assert (bench.glass.done, bench.marked) == (["b"], "a")
    assert bench.heard == ["step", "step", "act"]
    (chosen,) = bench.chosen
    assert chosen.ended - chosen.began == pytest.approx(0.5, abs=TICK)


@pytest.mark.parametrize("one", [False, True], ids=["two switches", "one switch"])
@pytest.mark.parametrize("marked", ["nothing", "item", "repeatable", "group", "back"])
@pytest.mark.parametrize("acceptance", [0.0, 0.4])
def test_a_hold_of_b_is_stop_and_does_nothing_else(acceptance: float, marked: str, one: bool) -> None:
    bench = Bench(
        *(f"t{number}" for number in range(16 if marked in ("group", "back") else 2)),
        pace=Pace(by_itself=one, interval=1.0, first=0.0, loops=9),
        timing=Timing(acceptance=acceptance),
    )
    bench.glass.there[0] = bench.glass.target("t0", repeatable=marked == "repeatable")
    if marked != "nothing":
        bench.engine.wake(bench.now)
    if marked == "back":
        bench.press("B", acceptance + 0.1)
        while one and bench.glass.marked is not None and bench.glass.marked.kind != "back":
            bench.wait(0.3)
    before, depth = bench.glass.marked, bench.engine.scan.depth
    bench.press("B", max(0.85, acceptance + 0.35))
    assert (len(bench.stops), bench.glass.done) == (1, [])
    assert (bench.marked, bench.engine.scan.depth) == (
        "" if before is None else "+".join(target.name for target in before.targets),
        depth,
    )


@pytest.mark.parametrize("awake", [True, False])
@pytest.mark.parametrize(("first", "second"), [("A", "B"), ("B", "A")])
@pytest.mark.parametrize("apart", [0.0, 0.03, 0.3])
def test_both_together_are_stop_and_leave_the_mark_where_it_was(
    apart: float, first: Literal["A", "B"], second: Literal["A", "B"], awake: bool
) -> None:
    bench = Bench("start", "other")
    if awake:
        bench.press("A")
    before = bench.marked
    bench.down(first)
    bench.wait(apart)
    bench.down(second)
    assert len(bench.stops) == 1
    bench.wait(0.3)
    bench.up("A")
    bench.up("B")
    bench.wait(0.3)
    assert (bench.glass.done, bench.marked, len(bench.stops)) == ([], before, 1)


def test_a_step_follows_what_b_did_however_fast_the_other_hand_is() -> None:
    bench = Bench("a", "b", "c")
    bench.press("A")
    bench.press("A")
    bench.down("B")
    bench.wait(0.12)
    bench.up("B")
    bench.wait(0.03)
    bench.press("A")
    assert (bench.glass.done, bench.marked) == (["b"], "b")


def test_b_does_it_though_a_was_let_go_only_just_before() -> None:
    bench = Bench("a", "b", "c")
    bench.press("A")
    bench.down("A")
    bench.wait(0.06)
    bench.up("A")
    bench.wait(0.03)
    bench.press("B")
    assert bench.glass.done == ["b"]


def test_what_is_there_instead_when_b_is_let_go_is_not_done() -> None:
    bench = Bench("a", "b")
    bench.press("A")
    bench.down("B")
    bench.glass.there[0] = bench.glass.target("a", "Something else")
    bench.wait(0.7)
    bench.up("B")
    bench.wait(0.2)
    assert (bench.glass.done, bench.heard[-1]) == ([], "none")


def test_stop_needs_nothing_on_the_glass() -> None:
    bench = Bench()
    bench.press("B", 1.0)
    assert len(bench.stops) == 1


def test_a_held_leaves_the_group_as_if_its_own_step_had_not_been() -> None:
    bench = Bench(*(f"t{number}" for number in range(16)))
    bench.press("A")
    bench.press("A")
    bench.press("B")
    assert bench.marked == "t4"
    bench.press("A", 0.7)
    assert bench.marked == "t4+t5+t6+t7"
    bench.press("A", 0.7)
    assert bench.marked == "t0+t1+t2+t3"


def test_what_is_repeatable_is_done_by_one_press_each() -> None:
    bench = Bench()
    bench.glass.there = [bench.glass.target("a"), bench.glass.target("louder", repeatable=True)]
    bench.press("A")
    bench.press("A")
    for _ in range(3):
        bench.press("B")
    assert bench.glass.done == ["louder"] * 3
    assert [chosen.presses for chosen in bench.chosen] == [3, 1, 1]


def test_what_has_just_begun_to_mean_something_else_takes_no_press() -> None:
    bench = Bench("pause", "other")
    bench.press("A")
    bench.glass.there[0] = bench.glass.target("pause", "Resume")
    bench.press("B")
    assert (bench.glass.done, bench.heard[-1]) == ([], "none")
    bench.wait(0.6)
    bench.press("B")
    assert bench.glass.done == ["pause"]


def test_what_went_from_the_glass_is_not_done_and_nor_is_what_is_there_instead() -> None:
    bench = Bench("a", "b")
    bench.press("A")
    bench.glass.there = [bench.glass.target("danger")]
    bench.press("B")
    assert bench.glass.done == []
    assert bench.marked == "danger"


def test_a_dialog_that_opens_is_marked_at_its_first() -> None:
    bench = Bench("a", "b")
    bench.press("A")
    bench.press("A")
    bench.glass.place, bench.glass.there = "dialog", [bench.glass.target("yes"), bench.glass.target("b")]
    bench.wait(0.3)
    assert bench.marked == "yes"


def test_with_one_switch_every_key_is_the_one_that_does() -> None:
    bench = Bench("a", "b", pace=Pace(by_itself=True, interval=1.0, first=0.0))
    bench.press("A")
    assert bench.marked == "a"
    bench.wait(0.85)
    assert bench.marked == "b"
    bench.press("A")
    assert bench.glass.done == ["b"]


def test_the_mark_does_not_move_by_itself_under_a_switch_that_is_down() -> None:
    bench = Bench(pace=Pace(by_itself=True, interval=0.5, first=0.0))
    bench.glass.there = [bench.glass.target("start"), bench.glass.target("other")]
    bench.press("B")
    bench.wait(0.1)
    bench.down("B")
    bench.wait(0.7)
    bench.up("B")
    bench.wait(0.15)
    assert bench.glass.done == ["start"]


def test_nor_does_it_between_the_end_of_a_press_and_what_comes_of_it() -> None:
    bench = Bench("start", "other", pace=Pace(by_itself=True, interval=0.5, first=0.0))
    bench.engine.wake(bench.now)
    bench.now += 0.49  # a press just before the step, shorter than a frame
    bench.down("B")
    bench.now += 0.02
    bench.up("B")
    bench.wait(0.15)
    assert bench.glass.done == ["start"]


def test_nobody_pressing_it_goes_to_sleep_and_then_costs_nothing() -> None:
    bench = Bench("a", "b", pace=Pace(by_itself=True, interval=0.5, first=0.0, loops=2))
    bench.press("B")
    bench.wait(3.0)
    assert (bench.marked, bench.engine.awake) == ("", False)
    asked = bench.glass.asked
    bench.wait(5.0)
    assert bench.glass.asked == asked


def test_a_stuck_switch_is_said_and_does_nothing() -> None:
    bench = Bench("a", "b")
    bench.down("A")
    bench.wait(6.0)
    assert bench.said == [("A", True)]
    bench.press("B")
    assert bench.stops == []
    bench.up("A")
    bench.wait(0.2)
    assert bench.said == [("A", True), ("A", False)]


def test_a_finger_on_the_glass_takes_the_mark_away_and_the_next_press_brings_it_back() -> None:
    bench = Bench("a", "b")
    bench.press("A")
    bench.engine.sleep()
    assert bench.glass.marked is None
    bench.press("B")
    assert (bench.marked, bench.glass.done) == ("a", [])


def test_presses_are_counted_from_one_choice_to_the_next() -> None:
    bench = Bench("a", "b", "c")
    bench.press("A")
    bench.press("A")
    bench.press("A")
    bench.press("B")
    bench.press("B")
    assert [(chosen.target.name, chosen.presses) for chosen in bench.chosen] == [("c", 4), ("a", 1)]


def test_whoever_asks_first_has_the_presses_but_not_stop() -> None:
    bench = Bench("a", "b")
    heard = []
    bench.engine.first = lambda event: heard.append(event.what) is None
    bench.press("B")
    bench.press("B", 1.0)
    assert heard == ["down", "up", "down"]
    assert len(bench.stops) == 1
    assert bench.glass.done == []


def with_b_held() -> Bench:
    """B is down on the first target."""
    bench = Bench("a", "b", "c")
    bench.press("A")
    bench.down("B")
    bench.wait(0.2)
    return bench


def test_what_b_held_when_the_mark_went_to_sleep_does_nothing_and_wakes_nothing() -> None:
    bench = with_b_held()
    bench.engine.sleep()
    bench.up("B")
    bench.wait(0.3)
    assert (bench.glass.done, bench.marked, bench.engine.awake) == ([], "", False)


def test_what_was_held_when_the_focus_went_does_nothing_and_wakes_nothing() -> None:
    bench = with_b_held()
    bench.engine.lost()
    bench.engine.found(bench.now)
    bench.up("B")
    bench.wait(0.3)
    assert (bench.glass.done, bench.marked) == ([], "a")
