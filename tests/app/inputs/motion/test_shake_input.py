"""Shaking as a way in: armed only while it is wanted, what each direction comes to, and what is kept."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.device.motion import NoMotion, SimulatedMotion
from app.device.vibration import DONE, STOPS, Pattern
from app.inputs.motion import shake_input as module
from app.inputs.motion.motion_sensing import MotionSensing
from app.inputs.motion.shake import AXES, Axis, PersonalAxis, own_to
from app.inputs.motion.shake_input import CHOICES, ShakeInput
from app.intents.intents import Heard, Verdict
from bench.support import motion
from bench.support.motion import Recording

OWN: dict[Axis, PersonalAxis] = {"lr": PersonalAxis((1.0, 0.0, 0.0), 8.0, 0.4)}


class Hand:
    """A handheld with a simulated sensor, and an app that notes what it is asked for."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, source: Any = None, **kept: Any) -> None:
        self.t, self.quarters = 100.0, 0
        self.kept: dict[str, Any] = {"shake": kept} if kept else {}
        self.heard: list[Heard] = []
        self.felt: list[Pattern] = []
        monkeypatch.setattr(module, "vibrate", self.felt.append)
        self.source = source or SimulatedMotion(now=lambda: self.t)
        self.sensing = MotionSensing(self.source, lambda: self.t)
        self.rests = self.stoppable = True
        self.app = SimpleNamespace(
            settings=SimpleNamespace(
                get=lambda name, default=None: self.kept.get(name, default), set=self.kept.__setitem__
            ),
            sensing=self.sensing,
            intents=SimpleNamespace(submit=self._take, possible=lambda _: self.stoppable),
            session=SimpleNamespace(
                feeds=SimpleNamespace(latest=lambda _: SimpleNamespace(at_rest=self.rests))
            ),
        )
        self.shaking = ShakeInput(self.app, lambda: self.t, lambda: self.quarters)

    def _take(self, heard: Heard) -> Verdict:
        self.heard.append(heard)
        return Verdict("acted", f"{heard.intent}.")

    def does(self, take: Recording) -> None:
        for axes in take.samples.tolist():
            self.t += 1 / take.rate
            self.source.put("acceleration", self.t, tuple(axes))
            self.sensing.update(self.t)

    def shakes(self, axis: str, person: int = 0) -> None:
        self.does(motion.trials([motion.made(axis, person, 0)], 1)[0].take)

    @property
    def intents(self) -> list[str]:
        return [heard.intent for heard in self.heard]


@pytest.fixture
def hand(monkeypatch: pytest.MonkeyPatch) -> Hand:
    hand = Hand(monkeypatch, on=True)
    hand.shaking.start()
    return hand


def test_left_right_is_stop_and_the_others_what_they_usually_mean(hand: Hand) -> None:
    for axis in AXES:
        hand.shakes(axis)
    assert hand.intents == ["stop", "pause", "resume"]
    assert {heard.method for heard in hand.heard} == {"shake"}
    assert [heard.said for heard in hand.heard] == ["left-right", "up-down", "forward-back"]
    assert hand.shaking.said == "resume."


def test_when_it_began_and_ended_is_told_and_stop_has_not_ended(hand: Hand) -> None:
    hand.shakes("lr")
    hand.shakes("ud")
    stop, pause = hand.heard
    assert math.isnan(stop.ended)
    assert 1.5 < pause.ended - pause.began < 4.0
    assert 0.0 < stop.confidence <= 1.0


def test_what_was_measured_goes_along_for_the_log(hand: Hand) -> None:
    hand.shakes("ud")
    snippet = hand.heard[0].snippet
    assert snippet["axis"] == "ud"
    assert 120 < len(snippet["acceleration"]) < 400
    assert snippet["acceleration"][0][0] == pytest.approx(0.0, abs=0.02), "from its own beginning"


def test_the_hand_feels_it_and_stop_longer(hand: Hand) -> None:
    hand.shakes("lr")
    hand.shakes("ud")
    assert hand.felt == [STOPS, DONE]


def test_off_the_sensor_is_off_and_nothing_is_understood(hand: Hand) -> None:
    assert hand.source.running
    hand.shaking.on = False
    hand.shaking.stop()
    assert not hand.source.running
    hand.shakes("lr")
    assert hand.heard == []
    assert hand.shaking.standing == "off"


def test_it_begins_once_however_often_it_is_started(hand: Hand) -> None:
    hand.shaking.start()
    hand.shakes("ud")
    assert hand.intents == ["pause"]


def test_left_and_right_are_those_of_the_screen(hand: Hand) -> None:
    """A tablet on its side: what is its own y lies along the screen's x."""
    hand.quarters = 1
    hand.shaking.update(hand.t)
    trial = motion.trials([motion.made("lr", 0, 0)], 1)[0].take
    x, y, z = trial.samples.T
    hand.does(Recording("", "", trial.rate, np.stack([y, -x, z], axis=1)))
    assert hand.intents == ["stop"]


# what may be chosen


def test_a_direction_means_what_was_chosen_and_that_is_kept(hand: Hand) -> None:
    hand.shaking.mean("ud", "go_home")
    hand.shaking.mean("fb", "")
    hand.shakes("ud")
    hand.shakes("fb")
    assert hand.intents == ["go_home"]
    assert hand.shaking.said == "Forward-back means nothing."
    assert hand.kept["shake"]["ud"] == "go_home"
    assert ShakeInput(hand.app).meaning == {"ud": "go_home", "fb": ""}


@pytest.mark.parametrize(("axis", "intent"), [("lr", "pause"), ("ud", "start"), ("fb", "stop!")])
def test_what_it_cannot_mean_is_refused(hand: Hand, axis: Any, intent: str) -> None:
    with pytest.raises(ValueError, match="cannot mean"):
        hand.shaking.mean(axis, intent)


def test_every_choice_is_an_intent_that_shaking_can_say() -> None:
    from app.intents.method_permits import SAYS

    assert {name for names in CHOICES.values() for name in names if name} <= set(SAYS["shake"])


def test_any_strong_shake_stops_a_robot_that_moves_where_that_is_wanted(hand: Hand) -> None:
    hand.shaking.any_stops = True
    hand.shakes("ud", 4)
    assert hand.intents == ["pause"], "it rests"
    hand.rests = False
    hand.shakes("ud", 4)
    assert hand.intents == ["pause", "stop"]
    assert hand.heard[1].said == "strong shake"
    assert ShakeInput(hand.app).any_stops


# the lesson


def test_the_lesson_is_kept_and_nothing_is_understood_meanwhile(hand: Hand) -> None:
    hand.shaking.on = False
    hand.shaking.stop()
    hand.shaking.teach()
    assert hand.source.running, "for the lesson, though it is off"
    for axis in AXES:
        take = motion.made(axis, 1, 0)
        still = np.tile(take.samples.mean(axis=0), (74, 1))
        hand.does(Recording("", "", 60.0, np.concatenate([still, take.samples[:180]])))
    assert hand.shaking.lesson is not None
    assert hand.shaking.lesson.over
    assert hand.felt == [DONE] * 3
    hand.shaking.end_lesson()
    assert not hand.source.running
    assert set(hand.shaking.own) == set(AXES)
    assert set(ShakeInput(hand.app).own) == set(AXES)
    assert hand.heard == []


def test_a_lesson_that_was_left_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    hand = Hand(monkeypatch, on=True, own=own_to(OWN))
    hand.shaking.teach()
    hand.shakes("lr")
    hand.shaking.end_lesson()
    assert hand.shaking.own == OWN
    hand.shaking.unlearn()
    assert hand.shaking.own == {}
    assert hand.kept["shake"]["own"] == {}


def test_a_pause_ends_the_lesson(hand: Hand) -> None:
    hand.shaking.teach()
    hand.shaking.stop()
    assert hand.shaking.lesson is None
    assert not hand.source.running


# bad input


@pytest.mark.parametrize(
    ("kept", "sentence"),
    [
        ({"ud": "stop"}, "Up-down cannot mean 'stop'; it means pause."),
        ({"fb": 3}, "Forward-back cannot mean 3; it means resume."),
        ({"own": [1]}, "What the lesson of shaking measured is a table"),
        ({"own": {"lr": {"way": [0, 0, 0], "peak": 9, "gap": 0.4}}}, "The lesson has to be done again."),
    ],
)
def test_settings_that_mean_nothing_are_said_and_the_usual_ones_taken(
    monkeypatch: pytest.MonkeyPatch, kept: dict[str, Any], sentence: str
) -> None:
    shaking = Hand(monkeypatch, **kept).shaking
    assert sentence in shaking.problem
    assert shaking.meaning == module.USUAL_MEANING
    assert shaking.own == {}
    assert not shaking.on


def test_without_a_sensor_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    hand = Hand(monkeypatch, NoMotion(), on=True)
    hand.shaking.start()
    assert hand.shaking.standing == "no sensor"
    assert hand.shaking.problem == "This computer has no motion sensor."


def test_a_slow_sensor_is_said_and_gives_no_command(hand: Hand) -> None:
    hand.does(motion.trials([motion.made("lr", 0, 0)], 1)[0].take.again(10.0))
    assert hand.shaking.standing == "10 Hz: too slow"
    assert hand.shaking.problem == "The motion sensor delivers 10 Hz, and at least 25 Hz are needed."
    assert hand.heard == []


def test_a_sensor_that_is_a_little_slow_still_stops_and_does_nothing_else(hand: Hand) -> None:
    for axis in AXES:
        hand.does(motion.trials([motion.made(axis, 0, 0)], 1)[0].take.again(19.0))
    assert hand.shaking.standing == "19 Hz: too slow"
    assert hand.intents == ["stop"]


def test_samples_that_come_twenty_at_once_and_twice_are_understood(hand: Hand) -> None:
    take = motion.trials([motion.made("lr", 0, 0)], 1)[0].take
    for index, axes in enumerate(take.samples.tolist()):
        hand.t += 1 / take.rate
        for _ in range(2):
            hand.source.put("acceleration", hand.t, tuple(axes))
        if index % 20 == 19:
            hand.sensing.update(hand.t)
    assert hand.intents == ["stop"]


def test_a_sensor_at_exactly_25_hz_is_quick_enough(hand: Hand) -> None:
    hand.does(motion.trials([motion.made("lr", 0, 0)], 1)[0].take.again(25.0))
    assert hand.shaking.problem == ""
    assert hand.intents == ["stop"]


def test_a_sensor_that_falls_silent_is_said(hand: Hand) -> None:
    hand.shakes("ud")
    hand.t += 2.0
    assert hand.shaking.problem == "The motion sensor is silent."


def test_while_it_is_tried_out_nothing_is_done_but_stop(hand: Hand) -> None:
    hand.shaking.try_out(on=True)
    hand.shakes("ud")
    assert (hand.intents, hand.shaking.last and hand.shaking.last.axis) == ([], "ud")
    assert hand.shaking.said == "Understood; while it is tried out nothing is done."
    hand.shakes("lr")
    assert hand.intents == ["stop"]
    hand.stoppable = False
    hand.shakes("lr")
    assert hand.intents == ["stop"], "there is nothing that it could stop"
    hand.shaking.try_out(on=False)
    hand.shakes("ud")
    assert hand.intents == ["stop", "pause"]


def test_it_is_tried_out_though_it_is_off_and_the_sensor_rests_after_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    hand = Hand(monkeypatch)
    hand.shaking.try_out(on=True)
    hand.shakes("fb")
    assert hand.shaking.last is not None
    assert hand.shaking.busy
    hand.shaking.try_out(on=False)
    assert not hand.source.running
    hand.shaking.try_out(on=True)
    hand.shaking.stop()
    assert not hand.shaking.trying
    assert not hand.source.running
