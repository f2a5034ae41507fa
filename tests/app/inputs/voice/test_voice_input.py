"""VoiceInput as a way in: when the ears are open, what counts, and what becomes of what was understood."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.inputs.voice.command_gate import DEAF, EARLIER
from app.inputs.voice.interfaces.speech_recognizer import (
    Grammar,
    Level,
    Rejected,
    Result,
    State,
    VoiceTrouble,
)
from app.inputs.voice.process.service import MUTED
from app.inputs.voice.talk_button import MAX_HOLD, TAP_TIMEOUT
from app.inputs.voice.voice_input import HEARS, RETRY_PERIOD, VoiceInput
from app.inputs.voice.voice_status import CLIPPED_TIME, CLIPS, DEAF_NOW, MUTED_NOW
from app.intents.intents import Heard, Intents
from app.intents.method_permits import MethodPermits
from tests.headless import Stage


class Recogniser:
    """Understands what the test says."""

    name, languages = "made up", ("en", "de")

    def __init__(self, absent: str = "", trouble: str = "") -> None:
        self.absent, self.trouble = absent, trouble
        self.open, self.heeded, self.grammar, self.hear = False, None, None, None
        self.orders: list[bool] = []

    def missing(self) -> str:
        return self.absent

    def start(self, grammar: Grammar, hear: Any) -> None:
        if self.trouble:
            raise VoiceTrouble(self.trouble)
        self.grammar, self.hear = grammar, hear
        hear(State("ready"))

    def listen(self, *, on: bool) -> None:
        self.open = on
        self.orders.append(on)
        self.hear(State("listening" if on else "ready"))

    def heed(self, commands: Any) -> None:
        self.heeded = commands

    def stop(self) -> None:
        self.grammar = None


class IntentActions:
    def __init__(self) -> None:
        self.done: list[str] = []
        self.asks = self.none = False

    def why_not(self, intent: str) -> str:
        if intent == "stop" and self.none:
            return "No robot is known."
        return "Nothing is asked just now." if intent in ("yes", "no") and not self.asks else ""

    def words(self, intent: str) -> str:
        return intent.capitalize()

    def do(self, intent: str) -> None:
        self.done.append(intent)

    def answer(self, yes: bool) -> str:
        self.asks = False
        return "Answered."


class Desk:
    """A handheld with such a recogniser, on a clock that the test moves."""

    def __init__(self, recogniser: Recogniser | None = None, **kept: Any) -> None:
        self.t, self.said, self.levels, self.unheard = 100.0, [], [], []
        self.kept = {"voice": {"on": True, **kept}}
        self.recogniser = recogniser or Recogniser()
        settings = SimpleNamespace(
            get=lambda name, default=None: self.kept.get(name, default), set=self.kept.__setitem__
        )
        self.acts = IntentActions()
        self.taken: list[Heard] = []
        tracks = SimpleNamespace(unheard=lambda *told, **_: self.unheard.append(told))
        self.app = SimpleNamespace(
            settings=settings,
            now=lambda: self.t,
            session=None,
            shell=None,
            connect=SimpleNamespace(say=self.say),
            talk=SimpleNamespace(on=False, speaking=False, spoke=-math.inf),
            inputs=SimpleNamespace(meanings=SimpleNamespace(held={"talk": []})),
            methods=SimpleNamespace(get=lambda _: SimpleNamespace(on=True, tracks=tracks)),
            intents=Intents(self.acts, MethodPermits(settings), lambda: self.t),
        )
        self.app.intents.on_taken.append(lambda heard, _: self.taken.append(heard))
        self.speaking = VoiceInput(self.app, lambda: self.recogniser)
        self.speaking.start()
        self.wait(0.0)

    def say(self, sentence: str, level: str) -> None:
        self.said.append(sentence)
        self.levels.append(level)

    def wait(self, seconds: float) -> None:
        self.t += seconds
        self.speaking.update(self.t)

    def says(self, command: str, **more: Any) -> None:
        self.recogniser.hear(
            Result(command, command, 0.9, **{"began": self.t - 0.5, "ended": self.t, **more})
        )
        self.speaking.update(self.t)


@pytest.fixture
def desk() -> Desk:
    return Desk()


# when the ears are open


def test_switched_off_nothing_is_made() -> None:
    desk = Desk(on=False)
    desk.speaking.stop()
    assert desk.recogniser.grammar is None
    assert desk.speaking.standing == "off"


def test_the_ears_are_closed_until_the_button_to_talk_is_held(desk: Desk) -> None:
    assert not desk.recogniser.open
    desk.speaking.press()
    assert desk.recogniser.open
    desk.wait(1.0)
    desk.speaking.release()
    assert not desk.recogniser.open


def test_a_tap_opens_them_for_one_command(desk: Desk) -> None:
    desk.speaking.press()
    desk.wait(0.1)
    desk.speaking.release()
    assert desk.recogniser.open
    desk.says("pause")
    assert not desk.recogniser.open


def test_a_tap_that_nothing_follows_is_over_by_itself(desk: Desk) -> None:
    desk.speaking.press()
    desk.speaking.release()
    desk.wait(TAP_TIMEOUT - 0.1)
    assert desk.recogniser.open
    desk.wait(0.2)
    assert not desk.recogniser.open


def test_what_lies_on_the_button_does_not_keep_them_open(desk: Desk) -> None:
    desk.speaking.press()
    desk.wait(MAX_HOLD + 0.1)
    assert not desk.recogniser.open


def test_a_key_or_a_button_of_a_gamepad_that_means_to_talk_holds_them_open(desk: Desk) -> None:
    (hold,) = desk.app.inputs.meanings.held["talk"]
    hold(True)
    assert desk.recogniser.open
    hold(False)
    assert not desk.recogniser.open


def test_hands_free_they_are_always_open() -> None:
    desk = Desk(hands_free=True)
    assert desk.recogniser.open
    desk.speaking.hands_free = False
    assert not desk.recogniser.open
    assert desk.kept["voice"]["hands_free"] is False


def test_stopped_it_lets_go_of_everything(desk: Desk) -> None:
    desk.speaking.press()
    desk.speaking.stop()
    assert desk.recogniser.grammar is None
    assert desk.app.inputs.meanings.held["talk"] == []


# what counts


def test_what_was_understood_is_a_wish_with_its_confidence_and_times(desk: Desk) -> None:
    desk.recogniser.hear(Level(-30.0, -52.0, 20.0))
    desk.says("pause", snr=21.0, detail={"explains": 0.2})
    (heard,) = desk.taken
    assert (heard.intent, heard.method, heard.confidence, heard.noise) == ("pause", "voice", 0.9, -52.0)
    assert (heard.began, heard.ended) == (99.5, 100.0)
    assert heard.snippet == {"snr": 21.0, "others": [], "explains": 0.2}
    assert desk.acts.done == ["pause"]


def test_stop_that_was_spotted_acts_and_has_no_end_yet(desk: Desk) -> None:
    desk.says("stop", early=True)
    assert desk.acts.done == ["stop"]
    assert math.isnan(desk.taken[0].ended)


def test_stop_does_not_wait_for_the_heartbeat(stage: Stage) -> None:
    desk = Desk()
    desk.recogniser.hear(Result("stop", "stop", 0.9, early=True))
    stage.frames(1)
    assert desk.acts.done == ["stop"]


def test_what_waits_is_answered_by_yes_no_and_pause_alone(desk: Desk) -> None:
    assert desk.recogniser.heeded is None
    desk.says("go_home")
    desk.wait(0.1)
    assert desk.recogniser.heeded == {"yes", "no", "pause"}
    desk.says("yes", began=desk.t + 0.1)
    assert desk.acts.done == ["go_home"]
    desk.wait(0.1)
    assert desk.recogniser.heeded is None


def test_a_question_of_the_robot_can_be_answered_and_commands_still_count(desk: Desk) -> None:
    desk.acts.asks = True
    desk.wait(0.1)
    assert {"yes", "no", "patrol", "stop"} <= desk.recogniser.heeded


def test_a_yes_from_before_the_question_is_no_answer(desk: Desk) -> None:
    began = desk.t
    desk.wait(0.3)
    desk.acts.asks = True
    desk.wait(0.1)
    desk.says("yes", began=began)
    assert desk.taken == []
    assert desk.speaking.said == EARLIER


def test_it_does_not_hear_its_own_voice_but_stop(desk: Desk) -> None:
    desk.app.talk.speaking = True
    desk.wait(0.1)
    assert desk.recogniser.heeded == frozenset()
    desk.says("pause")
    assert desk.acts.done == []
    assert desk.speaking.said == DEAF
    desk.says("stop")
    assert desk.acts.done == ["stop"]


def test_nor_what_is_left_of_it_in_the_room(desk: Desk) -> None:
    desk.app.talk.spoke = desk.t
    desk.says("pause", began=desk.t + 0.1)
    assert desk.acts.done == []
    desk.says("pause", began=desk.t + 0.4)
    assert desk.acts.done == ["pause"]


def test_an_app_that_cannot_talk_hears_all_the_same(desk: Desk) -> None:
    del desk.app.talk
    desk.wait(0.1)
    desk.says("pause")
    assert desk.acts.done == ["pause"]


def test_tried_out_nothing_is_done_about_it(desk: Desk) -> None:
    desk.speaking.try_out(on=True)
    assert desk.recogniser.open
    desk.says("go_home")
    assert desk.taken == []
    assert desk.speaking.last.command == "go_home"
    desk.speaking.try_out(on=False)
    assert not desk.recogniser.open


@pytest.mark.parametrize("session", [object(), None], ids=["connected", "known"])
def test_tried_out_stop_still_stops_whatever_could_be_stopped(desk: Desk, session: object) -> None:
    desk.app.session = session
    desk.speaking.try_out(on=True)
    desk.says("stop")
    assert desk.acts.done == ["stop"]


def test_tried_out_where_nothing_can_be_stopped_stop_is_understood_as_all_else(desk: Desk) -> None:
    desk.acts.none = True
    desk.speaking.try_out(on=True)
    desk.says("stop")
    assert desk.acts.done == []
    assert desk.speaking.said.startswith("Understood")


def test_tried_out_while_off_it_is_off_again_afterwards() -> None:
    desk = Desk(on=False)
    desk.speaking.stop()
    desk.speaking.try_out(on=True)
    assert desk.recogniser.open
    assert desk.speaking.busy
    desk.speaking.try_out(on=False)
    assert desk.recogniser.grammar is None


# what goes wrong


def test_what_was_not_understood_is_said_and_told_to_the_log(desk: Desk) -> None:
    desk.speaking.press()
    desk.recogniser.hear(Rejected("That was no command.", "go_home", 0.3, desk.t))
    desk.wait(0.0)
    assert desk.unheard == [("voice", "That was no command.")]
    assert desk.said == ["Voice: That was no command."]


@pytest.mark.parametrize(
    ("on", "command", "aloud"), [(True, "go_home", 1), (False, "go_home", 0), (True, "", 0)]
)
def test_a_command_that_is_refused_is_refused_aloud_while_the_app_talks(
    on: bool, command: str, aloud: int
) -> None:
    desk, told = Desk(), list[tuple[str, str]]()
    desk.app.talk.on, desk.app.talk.say = on, lambda *line: told.append(line)
    desk.speaking.press()
    desk.recogniser.hear(Rejected("Nothing is done.", command, ended=desk.t))
    desk.wait(0.0)
    assert told == [("Nothing is done.", "answer")] * aloud


def test_hands_free_what_people_talk_is_not_talked_of() -> None:
    desk = Desk(hands_free=True)
    desk.recogniser.hear(Rejected("Nothing was understood."))
    desk.wait(0.0)
    assert (desk.said, desk.unheard) == ([], [])


def test_where_it_is_too_loud_it_says_so_until_it_is_not(desk: Desk) -> None:
    desk.speaking.press()
    desk.recogniser.hear(State("too loud", "Too loud here for voice."))
    desk.wait(0.0)
    assert (desk.speaking.standing, desk.speaking.problem) == ("too loud", "Too loud here for voice.")
    desk.speaking.release()
    desk.wait(0.0)
    assert desk.speaking.loud, "closed ears have not heard that it is quiet"
    desk.speaking.press()
    desk.recogniser.hear(State("listening", "It is quiet enough for voice again."))
    desk.wait(0.0)
    assert (desk.speaking.standing, desk.speaking.problem) == ("listening", "")
    assert len(desk.said) == 2


@pytest.mark.parametrize("how", [{"absent": "There is no hama."}, {"trouble": "There is no hama."}])
def test_what_is_missing_is_a_sentence_and_everything_goes_on(how: dict[str, str]) -> None:
    desk = Desk(Recogniser(**how))
    assert desk.said == ["Voice: There is no hama."]
    assert (desk.speaking.problem, desk.speaking.standing) == ("There is no hama.", "does not work")
    desk.speaking.press()
    desk.speaking.release()


def test_a_microphone_pulled_out_is_said_and_the_next_press_opens_it_anew(desk: Desk) -> None:
    desk.speaking.press()
    desk.wait(0.0)
    desk.recogniser.hear(State("ready", "The microphone gives nothing any more."))
    desk.wait(0.0)
    assert desk.speaking.problem == "The microphone gives nothing any more."
    desk.speaking.press()
    desk.wait(0.0)
    assert desk.recogniser.orders == [True, True]
    assert desk.speaking.problem == ""


def test_hands_free_a_microphone_pulled_out_is_opened_anew_until_it_works() -> None:
    desk = Desk(hands_free=True)
    gone = State("ready", "The microphone gives nothing any more.")
    desk.recogniser.hear(gone)
    desk.wait(0.0)
    assert desk.speaking.standing == "deaf"
    assert desk.said == [f"Voice: {gone.sentence} {DEAF_NOW}"]
    assert desk.speaking.sign == "wrong"
    desk.recogniser.listen = lambda *, on: desk.recogniser.orders.append(on) or desk.recogniser.hear(gone)
    desk.wait(RETRY_PERIOD - 0.1)
    assert desk.recogniser.orders == [True]
    desk.wait(0.2)
    desk.wait(0.1)
    assert desk.recogniser.orders == [True, True]
    assert len(desk.said) == 1, "once"
    del desk.recogniser.listen
    desk.wait(RETRY_PERIOD + 0.1)
    desk.wait(0.1)
    assert desk.recogniser.orders == [True, True, True]
    assert (desk.speaking.problem, desk.said[-1]) == ("", f"Voice: {HEARS}")


def test_hands_free_a_muted_microphone_is_a_problem_until_there_is_a_sound() -> None:
    desk = Desk(hands_free=True)
    desk.recogniser.hear(State("muted", MUTED))
    for _ in range(3):
        desk.wait(RETRY_PERIOD)
        assert (desk.speaking.standing, desk.speaking.sign) == ("deaf", "wrong")
        assert desk.speaking.problem == f"{MUTED} {MUTED_NOW}"
    assert not desk.speaking.ready
    assert (desk.said, desk.levels) == ([f"Voice: {MUTED} {MUTED_NOW}"], ["warn"])
    assert desk.recogniser.orders == [True], (
        "its ears are open: it hears by itself when it is not muted any more"
    )
    desk.recogniser.hear(State("listening"))
    desk.wait(0.0)
    assert (desk.speaking.standing, desk.speaking.sign) == ("listening", "listening")
    assert (desk.speaking.problem, desk.said[1:], desk.levels[1:]) == ("", [f"Voice: {HEARS}"], ["info"])


def test_a_microphone_that_is_muted_where_it_was_too_loud_is_said_and_makes_nothing_quiet() -> None:
    desk = Desk(hands_free=True)
    for state in (State("too loud", "Too loud here for voice."), State("muted", MUTED)):
        desk.recogniser.hear(state)
        desk.wait(0.0)
    assert (desk.speaking.standing, desk.speaking.sign, desk.speaking.loud) == ("deaf", "wrong", True)
    assert (desk.said[-1], desk.levels) == (f"Voice: {MUTED} {MUTED_NOW}", ["warn", "warn"])
    desk.recogniser.hear(State("listening"))
    desk.wait(0.0)
    assert (desk.speaking.standing, desk.speaking.problem) == ("too loud", "Too loud here for voice.")


def test_an_overdriven_microphone_is_a_problem_for_as_long_as_it_is_and_still_listens(desk: Desk) -> None:
    desk.speaking.press()
    desk.wait(0.0)
    desk.recogniser.hear(Level(-1.0, -50.0, 20.0, clipped=True))
    assert (desk.speaking.problem, desk.speaking.sign) == (CLIPS, "listening")
    desk.wait(CLIPPED_TIME + 0.1)
    assert desk.speaking.problem == ""


def test_a_recogniser_that_fails_is_let_go_of_and_begun_anew_by_a_press(desk: Desk) -> None:
    desk.recogniser.hear(State("failed", "It crashed twice."))
    desk.wait(0.0)
    assert desk.recogniser.grammar is None
    assert desk.speaking.problem == "It crashed twice."
    desk.speaking.press()
    assert desk.recogniser.open


def test_a_language_that_is_not_known_is_english_and_said() -> None:
    desk = Desk(language="xx")
    assert desk.speaking.language == "en"
    assert "'xx'" in desk.said[0]


def test_another_language_has_its_own_words(desk: Desk) -> None:
    desk.speaking.language = "de"
    assert "licht" in desk.recogniser.grammar.phrases["lights"]
    assert desk.speaking.languages == ("en", "de")
    with pytest.raises(ValueError, match="There are no commands in 'xx'"):
        desk.speaking.language = "xx"


# what understands


def test_what_understands_is_chosen_kept_and_begun_anew(desk: Desk) -> None:
    assert (desk.speaking.recognizer, desk.speaking.model) == ("", "")
    assert set(desk.kept["voice"]) == {"on"}, "nothing is kept before anything is chosen"
    before = desk.recogniser.grammar
    desk.speaking.recognizer, desk.speaking.model = "vosk", " /models/small "
    assert desk.kept["voice"] | {"on": True} == desk.kept["voice"]
    assert (desk.kept["voice"]["recognizer"], desk.kept["voice"]["model"]) == ("vosk", "/models/small")
    assert desk.recogniser.grammar is not before
    with pytest.raises(ValueError, match="no recogniser 'ears'"):
        desk.speaking.recognizer = "ears"


def test_what_was_missing_is_tried_again_when_something_else_is_chosen() -> None:
    desk = Desk(Recogniser("There is no hama."))
    desk.recogniser.absent = ""
    desk.speaking.recognizer = "vosk"
    desk.wait(0.0)
    assert (desk.speaking.problem, desk.speaking.ready) == ("", True)
    off = Desk(Recogniser("There is no hama."), on=False)
    off.speaking.stop()
    off.recogniser.absent = ""
    off.speaking.recognizer = "vosk"
    assert off.recogniser.grammar is None


def test_that_another_listens_is_said_and_it_listens(monkeypatch: pytest.MonkeyPatch) -> None:
    other = Recogniser()
    why = "Voice needs the package hama. “By words” listens instead."
    asked: list[tuple[str, str]] = []
    monkeypatch.setattr(
        "app.inputs.voice.voice_input.choose", lambda *wanted: asked.append(wanted) or (other, why)
    )
    desk = Desk(recognizer="vosk", model="/models/small")
    speaking = VoiceInput(desk.app)
    speaking.start()
    speaking.press()
    assert asked == [("vosk", "/models/small")]
    assert desk.said == [f"Voice: {why}"]
    assert desk.levels == ["info"]
    assert other.open


@pytest.mark.parametrize("kept", [{"recognizer": "ears"}, {"recognizer": 3}, {"model": ["a"]}])
def test_a_recogniser_that_there_is_not_is_the_best_and_said(kept: dict[str, Any]) -> None:
    desk = Desk(**kept)
    assert (desk.speaking.recognizer, desk.speaking.model) == ("", "")
    assert "reset to default" in desk.said[0]
