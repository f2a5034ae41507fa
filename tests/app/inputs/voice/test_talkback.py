"""Talk-back: what is said aloud, in which order, and that it never says what the microphone would take for STOP."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from app.core.command_origin import Origin
from app.inputs.voice.recognition.sentences import STOPS, understand
from app.inputs.voice.talkback import MAX_AGE, MAX_WAITING, SENTENCE_TIMEOUT, SLEEP_TIMEOUT, Talkback, aloud
from app.intents.intents import Heard, Verdict
from app.link.channels import EVENT, OUTCOME
from app.link.commands import Outcome
from app.link.feeds import Post

SPOKEN = Heard("pause", "voice", 0.9)


class Mouth:
    """Says what it is given when the test lets it end."""

    def __init__(self, absent: str = "") -> None:
        self.absent, self.tell = absent, None
        self.said: list[str] = []

    def missing(self) -> str:
        return self.absent

    def start(self, tell: Any) -> None:
        self.tell = tell

    def say(self, words: str, rate: float) -> None:
        self.said.append(words)
        self.tell("began", words)

    def hush(self) -> None:
        self.said.append("(hush)")

    def stop(self) -> None:
        self.tell = None

    def ends(self) -> None:
        self.tell("ended", self.said[-1])


class Desk:
    def __init__(self, mouth: Mouth | None = None, **kept: Any) -> None:
        self.t, self.warned = 100.0, []
        self.kept = {"talk": {"on": True, **kept}}
        self.mouth = mouth or Mouth()
        self.session = SimpleNamespace(
            listeners=[],
            robot_stop=SimpleNamespace(phase="ready"),
            link=SimpleNamespace(robot_time=lambda: 0.0),
            logbook=SimpleNamespace(is_news=lambda event, _: event.news),
        )
        self.app = SimpleNamespace(
            settings=SimpleNamespace(
                get=lambda name, default=None: self.kept.get(name, default), set=self.kept.__setitem__
            ),
            now=lambda: self.t,
            session=self.session,
            shell=None,
            connect=SimpleNamespace(say=lambda text, level: self.warned.append(text)),
            intents=SimpleNamespace(on_taken=[]),
        )
        self.talking = Talkback(self.app, lambda _: self.mouth)
        if self.talking.on:
            self.talking.start()
        self.wait(0.0)

    def wait(self, seconds: float) -> None:
        self.t += seconds
        self.talking.update(self.t)

    def taken(self, heard: Heard, what: Any, sentence: str = "It is so.") -> None:
        for listener in self.app.intents.on_taken:
            listener(heard, Verdict(what, sentence))

    def told(self, channel: str, value: Any) -> None:
        for listener in list(self.session.listeners):
            listener(channel, Post(value, self.t, 1))


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_off_at_first_it_tells_nothing_but_what_is_marked() -> None:
    desk = Desk(on=False)
    desk.taken(SPOKEN, "asks")
    assert desk.mouth.said == []
    desk.app.talk.say("Map layers")
    assert desk.mouth.said == ["Map layers"]
    assert desk.talking.busy, "somebody has to tell it the time until it is over"


def test_a_question_and_a_refusal_are_told_at_once(desk: Desk) -> None:
    desk.taken(SPOKEN, "asks", "Go home?")
    desk.mouth.ends()
    desk.wait(0.1)
    desk.taken(SPOKEN, "not now", "No task runs.")
    assert desk.mouth.said == ["Go home?", "No task runs."]


def test_what_a_finger_pressed_is_not_told(desk: Desk) -> None:
    desk.taken(Heard("pause", "keyboard"), "not now", "No task runs.")
    assert desk.mouth.said == []


def test_what_a_robot_is_asked_for_is_told_only_when_it_has_confirmed_it(desk: Desk) -> None:
    desk.taken(SPOKEN, "acted", "Pause.")
    assert desk.mouth.said == []
    spoken = Origin("voice", 0.9)
    desk.told(OUTCOME, Outcome("pause", "1", "sent", origin=spoken))
    assert desk.mouth.said == []
    desk.told(OUTCOME, Outcome("pause", "1", "accepted", latency=0.02, origin=spoken))
    assert desk.mouth.said == ["Pause: the robot has accepted it."]


def test_a_refusal_of_the_robot_is_told_with_its_reason(desk: Desk) -> None:
    desk.told(OUTCOME, Outcome("home", "1", "refused", "There is no home.", origin=Origin("shake", 0.9)))
    assert desk.mouth.said == ["Go home: refused. There is no home."]


def test_what_is_done_on_the_handheld_needs_nobody_to_confirm_it(desk: Desk) -> None:
    desk.taken(Heard("snapshot", "voice"), "acted", "Snapshot.")
    assert desk.mouth.said == ["Snapshot."]


def test_stop_is_told_once_when_the_robot_confirms_it(desk: Desk) -> None:
    desk.session.robot_stop.phase = "waiting"
    desk.wait(0.1)
    assert desk.mouth.said == []
    desk.session.robot_stop.phase = "stopped"
    desk.wait(0.1)
    desk.mouth.ends()
    desk.wait(0.1)
    assert desk.mouth.said == ["braked: the robot confirms it."]


def test_an_alarm_breaks_off_what_is_said_and_the_newest_goes_first(desk: Desk) -> None:
    desk.talking.say("One.", "answer")
    desk.talking.say("Two.", "answer")
    for text, news in (("Old.", False), ("Battery low.", True), ("Link weak.", True)):
        desk.told(EVENT, SimpleNamespace(level="alarm", text=text, news=news))
    desk.told(EVENT, SimpleNamespace(level="info", text="Nothing.", news=True))
    assert desk.mouth.said == ["One.", "Battery low."]
    for _ in range(2):
        desk.mouth.ends()
        desk.wait(0.1)
    assert desk.mouth.said == ["One.", "Battery low.", "Link weak.", "Two."]


def test_of_what_is_marked_the_newest_alone_is_said(desk: Desk) -> None:
    for words in ("Map", "Layers", "Undo"):
        desk.talking.say(words)
    assert desk.mouth.said == ["Map", "Layers", "Undo"]
    desk.talking.say("An answer.", "answer")
    assert desk.mouth.said[-1] == "An answer."


def test_no_more_wait_than_can_be_listened_to(desk: Desk) -> None:
    for number in range(20):
        desk.talking.say(f"Number {number}.", "answer")
    for _ in range(20):
        desk.mouth.ends()
        desk.wait(0.1)
    assert desk.mouth.said == ["Number 0.", *(f"Number {n}." for n in range(20 - MAX_WAITING, 20))]


def test_what_has_waited_too_long_is_not_said_any_more_but_an_alarm(desk: Desk) -> None:
    desk.talking.say("One.", "alarm")
    desk.talking.say("Two.", "answer")
    desk.talking.say("Three.", "alarm")
    desk.wait(MAX_AGE + 0.1)
    desk.mouth.ends()
    desk.wait(0.1)
    desk.mouth.ends()
    desk.wait(0.1)
    assert desk.mouth.said == ["One.", "Three."]


def test_what_was_broken_off_does_not_end_what_came_after_it(desk: Desk) -> None:
    desk.talking.say("Map")
    desk.talking.say("Layers")
    desk.mouth.tell("ended", "Map")
    desk.wait(0.1)
    assert desk.talking.speaking
    desk.mouth.tell("ended", "Layers")
    desk.wait(0.1)
    assert not desk.talking.speaking
    assert desk.talking.spoke == desk.t


def test_a_voice_that_loses_a_sentence_does_not_leave_the_microphone_deaf(desk: Desk) -> None:
    desk.talking.say("One.", "answer")
    desk.wait(SENTENCE_TIMEOUT + 0.1)
    assert not desk.talking.speaking


def test_it_never_says_stop() -> None:
    assert aloud("STOP is pressed; it stopped “at once”.") == "brake is pressed; it braked at once ."


@pytest.mark.parametrize("word", STOPS)
def test_none_of_the_words_for_stop_is_said(word: str) -> None:
    assert understand(aloud(f"{word.capitalize()}: the robot confirms it.")) is None


def test_a_minute_of_silence_puts_the_voice_away(desk: Desk) -> None:
    desk.talking.say("One.", "answer")
    desk.mouth.ends()
    desk.wait(0.1)
    desk.wait(SLEEP_TIMEOUT + 0.1)
    assert desk.mouth.tell is None
    assert not desk.talking.busy


def test_where_nothing_can_talk_it_is_said_once_and_everything_goes_on() -> None:
    desk = Desk(Mouth("There is no hibari."))
    desk.talking.say("One.", "answer")
    desk.talking.say("Two.", "answer")
    assert desk.warned == ["Talk-back: There is no hibari."]
    assert desk.talking.standing == "silent"


def test_where_the_voice_that_is_chosen_is_missing_another_talks_and_it_is_said_once() -> None:
    desk, mouths = Desk(), {"natural": Mouth("There is no hibari."), "clear": Mouth()}
    desk.talking._make = mouths.__getitem__
    desk.talking.say("One.", "answer")
    assert mouths["clear"].said == ["One."]
    assert desk.warned == ["Talk-back: There is no hibari. “Clear, like a machine” talks instead."]
    mouths["clear"].ends()
    desk.wait(0.1)
    desk.wait(61.0)
    assert mouths["clear"].tell is None, "put away"
    desk.talking.say("Two.", "answer")
    assert mouths["clear"].said == ["One.", "Two."]
    assert len(desk.warned) == 1
    assert (desk.talking.problem, desk.talking.voice) == ("", "natural")


def test_a_voice_that_crashes_is_said_and_silent_until_it_is_chosen_again(desk: Desk) -> None:
    desk.talking.say("One.", "answer")
    desk.mouth.tell("failed", "It crashed.")
    desk.wait(0.1)
    assert (desk.talking.problem, desk.talking.speaking) == ("It crashed.", False)
    desk.talking.voice = "clear"
    desk.talking.say("Two.", "answer")
    assert desk.mouth.said[-1] == "Two."


def test_settings_out_of_range_are_the_usual_ones() -> None:
    desk = Desk(voice="soprano", rate=9.0)
    assert (desk.talking.voice, desk.talking.rate) == ("natural", 1.0)
    with pytest.raises(ValueError, match="9"):
        desk.talking.rate = 9.0
