"""Where voice is set up: what it shows, what a finger changes, and that the try ends with the pane."""

from __future__ import annotations

import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Level, Rejected, Result
from app.screens.inputs.panes.voice_pane import FREE, PUSH, TRY, VoicePane
from tests.headless import Stage


class VoiceInput:
    """The method as the pane sees it."""

    def __init__(self) -> None:
        self.on, self.hands_free, self.trying, self.language = True, False, False, "en"
        self.languages: tuple[str, ...] = ("en",)
        self.recognizer, self.model = "", ""
        self.problem, self.standing, self.said = "", "hold to talk", ""
        self.loud, self.ready, self.listening = False, True, False
        self.level, self.last = Level(-40.0, -55.0, 25.0), None

    def try_out(self, *, on: bool) -> None:
        self.trying = self.listening = on


class Talkback:
    def __init__(self) -> None:
        self.on, self.voice, self.rate, self.problem = False, "natural", 1.0, ""
        self.spoken: list[str] = []

    def say(self, words: str, kind: str) -> None:
        self.spoken.append(words)


class Desk:
    def __init__(self, stage: Stage, languages: tuple[str, ...] = ("en",)) -> None:
        self.speaking, self.talking, self.stage = VoiceInput(), Talkback(), stage
        self.speaking.languages = languages
        methods = {"voice": self.speaking, "talk": self.talking}
        app: Any = SimpleNamespace(methods=SimpleNamespace(get=methods.get, turn=self._turn))
        self.pane = stage.show(VoicePane(app=app), (420, 900))
        self.pane.enter()
        stage.frames(2)

    def _turn(self, name: str, on: bool) -> None:
        assert name == "talk"
        self.talking.on = on

    def tick(self) -> None:
        self.pane.tick()
        self.stage.frames(2)


@pytest.fixture
def desk(stage: Stage) -> Desk:
    return Desk(stage)


def test_tried_out_it_says_what_was_understood_and_that_nothing_is_done(desk: Desk) -> None:
    desk.pane.trial.dispatch("on_release")
    assert desk.speaking.trying
    assert desk.pane.standing.text == TRY
    desk.speaking.last = Result("go_home", "go home", 0.91)
    desk.tick()
    assert "Go home: “go home” · 91 % sure" in desk.pane.meter.texts
    desk.speaking.last = Rejected("That was no command.")
    desk.tick()
    assert "That was no command." in desk.pane.meter.texts


def test_the_try_ends_with_the_pane(desk: Desk) -> None:
    desk.pane.trial.dispatch("on_release")
    desk.pane.leave()
    assert not desk.speaking.trying


def test_a_problem_is_said_in_place_of_all_else(desk: Desk) -> None:
    desk.speaking.problem = "There is no microphone."
    desk.tick()
    assert desk.pane.standing.text == "There is no microphone."
    assert desk.pane.standing.role == "warn"


def test_the_meter_is_live_only_while_the_ears_are_open(desk: Desk) -> None:
    assert (desk.pane.meter.state, desk.pane.meter.level) == ("never", -math.inf)
    desk.speaking.listening = True
    desk.tick()
    assert (desk.pane.meter.state, desk.pane.meter.level) == ("live", -40.0)
    desk.speaking.loud = True
    desk.tick()
    assert desk.pane.meter.state == "alarm"


def test_hands_free_is_chosen_with_a_word_of_warning(desk: Desk) -> None:
    assert desk.pane.how.text == PUSH
    desk.pane.kind.choose("free")
    assert desk.speaking.hands_free
    assert desk.pane.how.text == FREE


def test_talk_back_its_voice_and_pace_are_chosen_and_tried(desk: Desk) -> None:
    desk.pane.talks.dispatch("on_change", True)
    desk.pane.voices.choose("clear")
    desk.pane.rate.dispatch("on_change", 1.3)
    desk.pane.example.dispatch("on_release")
    assert (desk.talking.on, desk.talking.voice, desk.talking.rate) == (True, "clear", 1.3)
    assert len(desk.talking.spoken) == 1


def test_every_command_stands_there_with_its_words(desk: Desk) -> None:
    assert desk.pane.words["go_home"].detail == "“go home” · “return home”"


def test_a_language_is_asked_for_only_where_there_are_several(stage: Stage, desk: Desk) -> None:
    assert desk.pane.language.parent is None
    several = Desk(stage, ("en", "de"))
    assert several.pane.language.parent is not None
    several.pane.language.choose("de")
    assert several.speaking.language == "de"


def test_what_understands_is_chosen_and_the_folder_of_a_model_asked_for_only_where_it_is_needed(
    desk: Desk, tmp_path: Path
) -> None:
    pane = desk.pane
    assert (pane.recognizers.value, pane.model.parent) == ("", None)
    pane.recognizers.choose("vosk")
    desk.tick()
    assert desk.speaking.recognizer == "vosk"
    assert pane.model.parent is not None
    assert pane.model.wrong, "there is no model yet"
    (tmp_path / "final.mdl").write_bytes(b"")
    pane.model.text = str(tmp_path)
    pane.model.dispatch("on_text_validate")
    assert (desk.speaking.model, pane.model.wrong) == (str(tmp_path), False)
    pane.recognizers.choose("phonemes")
    assert pane.model.parent is None
