"""The study: everybody is asked for everything equally often, and nothing that was answered is lost."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import pytest

from app.study.study import ANSWER_TIMEOUT, COMMANDS, Plan, Trials, latin_row, plan_of, saved


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 6])
def test_a_square_has_every_method_at_every_place_and_after_every_other_equally_often(count):
    people = count if count % 2 == 0 else 2 * count
    rows = [latin_row(count, row) for row in range(people)]
    for place in range(count):
        assert set(Counter(row[place] for row in rows).values()) == {people // count}
    after = Counter(pair for row in rows for pair in pairwise(row))
    assert len(after) == count * (count - 1)
    assert len(set(after.values())) <= 1


def test_the_square_goes_on_after_its_last_row():
    assert latin_row(4, 4) == latin_row(4, 0)


def test_every_command_is_asked_for_ten_times_by_every_method():
    for block in Plan(user="7").blocks():
        assert Counter(block.prompts) == dict.fromkeys(COMMANDS, 10)


def test_no_command_is_asked_for_twice_in_a_row():
    for row in range(1, 30):
        for block in Plan(user="7", row=row).blocks():
            assert all(one != other for one, other in pairwise(block.prompts))


def test_people_are_asked_in_different_orders_and_the_same_person_always_in_the_same():
    assert Plan(user="1", row=1).blocks() == Plan(user="1", row=1).blocks()
    assert Plan(user="1", row=1).blocks()[0].prompts != Plan(user="2", row=2).blocks()[0].prompts
    firsts = {Plan(user="x", row=row).blocks()[0].method for row in range(1, 7)}
    assert firsts == {"button", "voice", "shake"}


def test_a_method_that_can_say_less_is_asked_for_less():
    plan = Plan(user="7", methods=("shake",), commands={"shake": ("stop", "pause")}, triggers=3)
    assert Counter(plan.blocks()[0].prompts) == {"stop": 3, "pause": 3}


def test_standing_and_walking_change_places_from_person_to_person():
    both = ("standing", "walking")
    first = [block.posture for block in Plan(user="1", row=1, postures=both).blocks()]
    second = [block.posture for block in Plan(user="2", row=2, postures=both).blocks()]
    assert (first[:2], second[:2]) == (["standing", "walking"], ["walking", "standing"])


class Led:
    """Trials with a clock that is moved by hand."""

    def __init__(self, **more) -> None:
        self.now = 100.0
        self.missed, self.moves = [], 0
        plan = Plan(**{"user": "7", "methods": ("voice", "shake"), "triggers": 1, **more})
        self.trials = Trials(plan, now=lambda: self.now)
        self.trials.on_missed = self.missed.append
        self.trials.on_moved = self.moved

    def moved(self) -> None:
        self.moves += 1

    def wait(self, seconds: float) -> None:
        self.now += seconds
        self.trials.update(self.now)

    def next(self):
        self.wait(3.5)
        assert self.trials.prompt is not None
        return self.trials.prompt

    def answer_all(self) -> None:
        self.trials.begin()
        while self.trials.running:
            prompt = self.next()
            self.trials.on_command(prompt.intent, prompt.method)


def test_nothing_is_asked_before_somebody_begins():
    led = Led()
    led.wait(60)
    assert (led.trials.stage, led.trials.prompt) == ("ready", None)


def test_prompts_come_after_a_gap_that_nobody_can_count_along():
    led = Led()
    led.trials.begin()
    led.wait(1.4)
    assert led.trials.prompt is None
    assert led.next().intent == led.trials.now_block.prompts[0]


def test_an_answer_is_matched_with_its_prompt_and_the_next_one_follows():
    led = Led()
    led.trials.begin()
    prompt = led.next()
    assert led.trials.on_command("stop", prompt.method) == prompt
    assert (led.trials.stage, led.trials.trial) == ("gap", 1)
    assert led.next().id != prompt.id


def test_what_comes_between_prompts_or_by_another_method_answers_nothing():
    led = Led()
    led.trials.begin()
    assert led.trials.on_command("stop", "voice") is None
    prompt = led.next()
    other = "shake" if prompt.method == "voice" else "voice"
    assert led.trials.on_command(prompt.intent, other) is None
    assert led.trials.prompt == prompt


def test_a_prompt_that_nobody_answers_is_missed_once():
    led = Led()
    led.trials.begin()
    prompt = led.next()
    led.wait(ANSWER_TIMEOUT - 0.1)
    assert led.missed == []
    led.wait(0.1)
    led.wait(0.1)
    assert led.missed == [prompt]
    assert led.trials.trial == 1


def test_a_pause_asks_again_for_what_was_shown_and_notes_nothing():
    led = Led()
    led.trials.begin()
    prompt = led.next()
    led.trials.pause()
    led.wait(3600)
    assert (led.trials.stage, led.missed) == ("paused", [])
    assert led.trials.on_command(prompt.intent, prompt.method) is None
    led.trials.begin()
    again = led.next()
    assert again.intent == prompt.intent
    assert again.id != prompt.id


def test_each_block_ends_with_the_load_and_all_of_it_with_the_usability():
    led = Led()
    stages = []
    for _ in led.trials.blocks:
        led.answer_all()
        stages.append(led.trials.stage)
        led.trials.filled()
        stages.append(led.trials.stage)
    led.trials.filled()
    stages.append(led.trials.stage)
    assert stages == ["tlx", "ready", "tlx", "sus", "done"]


def test_what_was_saved_goes_on_where_it_was():
    led = Led()
    led.trials.begin()
    for _ in range(2):
        prompt = led.next()
        led.trials.on_command(prompt.intent, prompt.method)
    found = plan_of(saved(led.trials), ("voice", "shake"), COMMANDS)
    assert found is not None
    plan, block, trial = found
    assert plan == led.trials.plan
    again = Trials(plan, now=lambda: 0.0, block=block, trial=trial)
    assert (again.stage, again.block, again.trial) == ("ready", 0, 2)
    assert led.moves == 2


def test_a_form_that_was_open_when_the_app_ended_is_asked_for_again():
    led = Led()
    led.answer_all()
    assert Trials(led.trials.plan, now=lambda: 0.0, block=0, trial=led.trials.trial).stage == "tlx"


@pytest.mark.parametrize(
    "change",
    [
        {"row": 0},
        {"row": "x"},
        {"row": float("inf")},
        {"methods": [["voice"]]},
        {"postures": [{}]},
        {"commands": {"voice": [["stop"]]}},
        {"methods": []},
        {"methods": ["telepathy"]},
        {"postures": ["swimming"]},
        {"triggers": 0},
        {"triggers": 10_000},
        {"commands": {"voice": ["explode"]}},
        {"block": None},
    ],
)
def test_what_was_saved_and_means_nothing_is_no_plan(change):
    kept = {**saved(Led().trials), **change}
    assert plan_of(kept, ("voice", "shake"), COMMANDS) is None


def test_nothing_saved_is_no_plan():
    assert plan_of(None, ("voice",), COMMANDS) is None


def test_the_last_form_that_was_open_when_the_app_ended_is_asked_for_again():
    led = Led()
    led.trials.block = len(led.trials.blocks) - 1
    led.trials.stage = "tlx"
    led.trials.filled()
    assert led.trials.stage == "sus"
    plan, block, trial = plan_of(saved(led.trials), ("voice", "shake"), COMMANDS)
    again = Trials(plan, now=lambda: 0.0, block=block, trial=trial)
    assert again.stage == "sus"
    again.filled()
    plan, block, trial = plan_of(saved(again), ("voice", "shake"), COMMANDS)
    assert Trials(plan, now=lambda: 0.0, block=block, trial=trial).stage == "done"
