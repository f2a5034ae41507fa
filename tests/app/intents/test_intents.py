"""What comes of what was understood: forbidden, impossible now, at once, after a bar, after a yes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import pytest

from app.core.command_origin import NOBODY, Origin, origins
from app.intents.intents import CANCEL_TIME, CONFIRM_TIME, INTENTS, METHODS, Heard, Intents, Verdict
from app.intents.method_permits import SAYS, MethodPermits


class Notes:
    """What the app does, noted; what cannot be done now has a reason."""

    def __init__(self) -> None:
        self.done: list[tuple[str, Origin]] = []
        self.reasons: dict[str, str] = {
            "yes": "Nothing is asked just now.",
            "no": "Nothing is asked just now.",
        }
        self.answers: list[bool] = []

    def why_not(self, intent: str) -> str:
        return self.reasons.get(intent, "")

    def words(self, intent: str) -> str:
        return INTENTS[intent].words

    def do(self, intent: str) -> None:
        self.done.append((intent, origins.current()))

    def answer(self, yes: bool) -> str:
        self.answers.append(yes)
        return "Has it been picked up? Yes."

    @property
    def names(self) -> list[str]:
        return [name for name, _ in self.done]


class Stage:
    """The way in, on a clock that is set by hand."""

    def __init__(self, settings: dict[str, Any] | None = None) -> None:
        self.time, self.settings, self.acts = 100.0, settings or {}, Notes()
        self.permits = MethodPermits(Kept(self.settings))
        self.intents = Intents(self.acts, self.permits, lambda: self.time)
        self.told: list[tuple[str, Verdict]] = []
        self.intents.on_taken.append(lambda heard, verdict: self.told.append((heard.intent, verdict)))

    def say(self, intent: str, method: str = "voice", **kwargs: Any) -> str:
        return self.intents.submit(Heard(intent, method, **kwargs)).what

    def wait(self, seconds: float) -> None:
        end = self.time + seconds
        while self.time < end:
            self.frame(min(0.03, end - self.time))

    def frame(self, seconds: float) -> None:
        self.time += seconds
        self.intents.update(self.time)


class Kept:
    def __init__(self, values: dict[str, Any]) -> None:
        self.values = values

    def get(self, name: str, default: Any = None) -> Any:
        return self.values.get(name, default)

    def set(self, name: str, value: Any) -> None:
        self.values[name] = value


@pytest.fixture
def stage() -> Stage:
    return Stage()


# risk


@pytest.mark.parametrize("method", [method for method in METHODS if method != "tilt"])
def test_stop_acts_at_once_whoever_says_it(stage: Stage, method: str) -> None:
    assert stage.say("stop", method) == "acted"
    assert stage.acts.names == ["stop"]


def test_stop_is_done_before_anybody_hears_of_what_it_takes_the_place_of(stage: Stage) -> None:
    stage.say("go_home")
    done: list[list[str]] = []
    stage.intents.on_taken.append(lambda *_: done.append(stage.acts.names))
    stage.say("stop")
    assert done == [["stop"], ["stop"]]
    assert stage.intents.pending is None


def test_what_may_be_cancelled_acts_after_two_seconds_and_not_before(stage: Stage) -> None:
    assert stage.say("resume") == "waits"
    stage.wait(CANCEL_TIME - 0.01)
    assert stage.acts.names == []
    stage.wait(0.01)
    assert stage.acts.names == ["resume"]
    assert [verdict.what for _, verdict in stage.told] == ["waits", "acted"]


@pytest.mark.parametrize("how", ["keyboard", "gamepad"])
def test_what_was_pressed_waits_for_nothing(stage: Stage, how: str) -> None:
    assert stage.say("resume", how) == "acted"


@pytest.mark.parametrize("method", ["voice", "shake"])
@pytest.mark.parametrize("intent", [name for name, intent in INTENTS.items() if intent.risk == "cancel"])
def test_what_was_guessed_can_be_cancelled_however_sure_it_is(stage: Stage, method: str, intent: str) -> None:
    assert stage.say(intent, method, confidence=1.0) in ("waits", "not allowed")
    assert stage.acts.names == []


def test_what_may_be_cancelled_does_not_act_out_of_a_frame_in_which_nobody_could(stage: Stage) -> None:
    stage.wait(1.0)
    stage.say("resume")
    stage.wait(0.5)
    stage.frame(2.2)
    assert stage.acts.names == [], "the glass stood still: nobody saw it"
    stage.wait(CANCEL_TIME - 0.7)
    assert stage.acts.names == []
    stage.say("no")
    stage.wait(10.0)
    assert stage.acts.names == []


def test_what_sets_something_in_motion_is_done_after_a_yes_by_whichever_method(stage: Stage) -> None:
    assert stage.say("go_home", said="go home", confidence=0.8, began=98.0, ended=99.0) == "asks"
    assert stage.say("yes", "switches") == "acted"
    assert stage.acts.names == ["go_home"]
    origin = stage.acts.done[0][1]
    assert (origin.method, origin.said, origin.confidence) == ("voice", "go home", 0.8)
    assert (origin.began, origin.ended, origin.decided, origin.intent) == (98.0, 99.0, 100.0, "go_home")


def test_being_quite_sure_does_not_set_anything_in_motion_unasked(stage: Stage) -> None:
    assert stage.say("go_home", confidence=1.0) == "asks"
    assert stage.acts.names == []


def test_a_question_without_an_answer_lapses(stage: Stage) -> None:
    stage.say("go_home")
    stage.wait(CONFIRM_TIME)
    assert stage.acts.names == []
    assert stage.told[-1] == ("go_home", Verdict("lapsed", "Not done, no yes came: Go home."))
    assert stage.say("yes") == "not now"


@pytest.mark.parametrize("intent", ["resume", "go_home"])
def test_a_no_cancels_what_waits(stage: Stage, intent: str) -> None:
    stage.say(intent)
    assert stage.intents.answer(False).sentence.startswith("Cancelled")
    stage.wait(10.0)
    assert stage.acts.names == []
    assert ("cancelled" in [verdict.what for _, verdict in stage.told]) is True


def test_a_yes_hastens_what_waits_to_be_cancelled(stage: Stage) -> None:
    stage.say("resume")
    stage.intents.answer(True)
    assert stage.acts.names == ["resume"]
    stage.wait(10.0)
    assert stage.acts.names == ["resume"]


@pytest.mark.parametrize("newer", ["stop", "pause", "resume"])
def test_a_newer_wish_takes_the_place_of_what_waits(stage: Stage, newer: str) -> None:
    stage.say("go_home")
    stage.say(newer)
    stage.wait(10.0)
    assert stage.acts.names == [newer]


def test_what_cannot_be_done_any_more_when_its_time_comes_is_not_done(stage: Stage) -> None:
    stage.say("resume")
    stage.acts.reasons["resume"] = "STOP is pressed; release it first."
    stage.wait(CANCEL_TIME)
    assert stage.acts.names == []
    assert stage.told[-1][1] == Verdict("not now", "STOP is pressed; release it first.")


def test_what_was_switched_and_seen_is_not_asked_again(stage: Stage) -> None:
    assert stage.say("go_home", "switches") == "acted"


def test_leaving_the_robot_forgets_what_waits(stage: Stage) -> None:
    stage.say("resume")
    stage.intents.rest()
    stage.wait(10.0)
    assert stage.acts.names == []


# refusals


def test_what_is_impossible_now_is_said_and_leaves_what_waits_alone(stage: Stage) -> None:
    stage.say("go_home")
    stage.acts.reasons["lights"] = "This robot has no lights to switch."
    assert stage.intents.submit(Heard("lights", "voice")) == Verdict(
        "not now", "This robot has no lights to switch."
    )
    assert stage.intents.pending is not None


def test_yes_is_understood_only_while_something_asks(stage: Stage) -> None:
    assert not stage.intents.asking
    assert stage.say("yes") == "not now"
    stage.acts.reasons.clear()
    assert stage.intents.asking
    assert stage.say("yes") == "acted"
    assert stage.acts.answers == [True]


def test_what_waits_here_is_answered_before_what_the_robot_asks(stage: Stage) -> None:
    stage.acts.reasons.clear()
    stage.say("go_home")
    stage.say("yes")
    assert (stage.acts.names, stage.acts.answers) == (["go_home"], [])


# the table


def test_a_shake_may_not_start_anything_until_it_is_allowed(stage: Stage) -> None:
    verdict = stage.intents.submit(Heard("start", "shake"))
    assert verdict == Verdict(
        "not allowed", "Shake may not do that: Start the task. It can be allowed in Inputs."
    )
    stage.permits.allow("shake", "start", True)
    assert stage.say("start", "shake") == "asks"
    assert Stage(stage.settings).say("start", "shake") == "asks", "it is not remembered"


def test_what_is_forbidden_stays_so_until_that_method_is_as_usual_again(stage: Stage) -> None:
    for method in ("voice", "shake"):
        stage.permits.allow(method, "pause", False)
        assert not stage.permits.usual(method)
    assert stage.say("pause") == "not allowed"
    stage.permits.reset("voice")
    assert stage.permits.usual("voice")
    assert stage.say("pause") == "acted"
    assert not stage.permits.usual("shake")
    assert stage.say("pause", "shake") == "not allowed"


@pytest.mark.parametrize("method", [method for method in SAYS if SAYS[method]])
def test_stop_cannot_be_forbidden(method: str) -> None:
    table = Stage({"intents": {method: {"stop": False}}}).permits
    assert table.allowed(method, "stop")
    assert table.problem
    with pytest.raises(ValueError, match="cannot be changed"):
        table.allow(method, "stop", False)


@pytest.mark.parametrize(
    "kept", [[], "all", {"voice": 3}, {"nose": {}}, {"voice": {"pause": "no"}}, {"voice": {"x": True}}]
)
def test_a_table_that_means_nothing_is_as_usual_and_said(kept: object) -> None:
    table = Stage({"intents": kept}).permits
    assert table.problem.endswith("reset to default.")
    assert table.allowed("voice", "pause")
    assert not table.allowed("shake", "start")


def test_tilt_says_nothing_and_a_finger_is_always_allowed(stage: Stage) -> None:
    assert not any(stage.permits.allowed("tilt", intent) for intent in INTENTS)
    assert all(stage.permits.allowed("button", intent) for intent in INTENTS)


# origins


@pytest.fixture
def untouched() -> Iterator[None]:
    origins.forget()
    yield
    origins.forget()


def test_without_a_word_about_it_a_command_comes_from_the_finger_that_came_down_last(untouched: None) -> None:
    origins.touched(7.0)
    origins.lifted(7.2)
    assert origins.current() == Origin("button", began=7.0, ended=7.2)
    with origins.during(Origin("shake")):
        assert origins.current().method == "shake"
    assert origins.current().method == "button"


def test_what_is_done_long_after_a_touch_was_asked_for_by_nobody(untouched: None) -> None:
    assert origins.current() is NOBODY
    origins.touched(7.0)
    origins.update(30.0)
    assert origins.current().began == 7.0, "the finger is still down"
    origins.lifted(30.0)
    origins.update(30.9)
    assert origins.current().method == "button"
    origins.update(31.1)
    assert origins.current() is NOBODY


def test_a_finger_that_holds_a_stick_goes_on_when_another_one_is_lifted(untouched: None) -> None:
    origins.touched(7.0)
    origins.touched(8.0)
    origins.lifted(8.1)
    origins.update(20.0)
    assert origins.current().method == "button"


def test_a_key_that_is_typed_into_a_field_is_no_finger(untouched: None) -> None:
    origins.typed(9.0)
    assert origins.current() == Origin("keyboard", began=9.0, ended=9.0)


# what is chosen on the glass


def test_a_choice_on_the_glass_is_barred_by_the_study_and_the_operator_as_everything_else(
    stage: Stage,
) -> None:
    done: list[str] = []
    heard = Heard("pause", "switches", began=1.0, said="Pause")
    assert stage.intents.choose(heard, lambda: done.append(origins.current().intent)).what == "acted"
    stage.permits.allow("switches", "pause", False)
    assert stage.intents.choose(heard, lambda: done.append("forbidden")).what == "not allowed"
    stage.intents.practise = lambda _: "Pause."
    assert stage.intents.choose(heard, lambda: done.append("practised")).what == "practised"
    assert done == ["pause"]
    assert [verdict.what for _, verdict in stage.told] == ["acted", "not allowed", "practised"]


def test_a_choice_without_an_intent_is_done_and_nobody_is_told(stage: Stage) -> None:
    done: list[Origin] = []
    stage.intents.choose(Heard("", "switches", said="Zoom in"), lambda: done.append(origins.current()))
    assert (done[0].method, done[0].said, stage.told) == ("switches", "Zoom in", [])


def test_a_question_that_takes_only_a_no_is_a_question(stage: Stage) -> None:
    stage.acts.reasons["yes"] = "Not yet: STOP is pressed."
    del stage.acts.reasons["no"]
    assert stage.intents.asking
    assert stage.intents.answer(yes=True, method="voice").sentence == "Not yet: STOP is pressed."


def test_an_unknown_confidence_stays_unknown(stage: Stage) -> None:
    stage.say("pause", confidence=math.nan)
    assert math.isnan(stage.acts.done[0][1].confidence)
