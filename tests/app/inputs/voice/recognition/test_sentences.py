"""Sentences of operators mean a command as a whole, or nothing is done."""

from __future__ import annotations

import pytest

from app.inputs.voice.recognition.sentences import MAX_WORDS, SENTENCES, STOPS, Meaning, understand
from app.intents.intents import INTENTS


def command(sentence: str) -> str:
    found = understand(sentence)
    return found.command if found is not None and found.counts else ""


@pytest.mark.parametrize(
    ("sentence", "intent"),
    [
        ("don't go home", "go_home"),
        ("Do not go home", "go_home"),
        ("never take off", "take_off"),
        ("I don’t want you to start the patrol", "patrol"),
        ("you mustn't resume", "resume"),
        ("please do not carry on", "resume"),
        ("anything but faster", "faster"),
    ],
)
def test_what_is_denied_is_no_command_and_is_known_for_denied(sentence: str, intent: str) -> None:
    found = understand(sentence)
    assert found is not None
    assert (found.command, found.negated, found.counts) == (intent, True, False)


@pytest.mark.parametrize(
    ("sentence", "intent"),
    [
        ("go home Dave you have done enough", "go_home"),
        ("continue reading on page nine", "resume"),
        ("take off your jacket", "take_off"),
        ("land of hope and glory", "land"),
        ("the patrol was here", "patrol"),
    ],
)
def test_words_beside_a_command_make_it_a_question_and_never_the_command(sentence: str, intent: str) -> None:
    found = understand(sentence)
    assert found is not None
    assert (found.command, found.partly, found.counts) == (intent, True, False)


@pytest.mark.parametrize("sentence", ["", "what time is lunch", "he left the office", "star patrols"])
def test_talk_means_nothing(sentence: str) -> None:
    assert understand(sentence) is None


def test_a_long_talk_means_nothing_but_stop() -> None:
    talk = "go home " * MAX_WORDS
    assert understand(talk) is None
    assert command(f"{talk} halt") == "stop"


@pytest.mark.parametrize("word", STOPS)
@pytest.mark.parametrize("around", ["{}", "please {} now", "robot {} it", "don't {}", "no no {} Dave"])
def test_stop_in_each_of_its_words_is_stop_amid_anything(word: str, around: str) -> None:
    assert command(around.format(word)) == "stop"


@pytest.mark.parametrize("sentence", ["halter", "the freezer", "aborted", "stopping", "shop"])
def test_a_word_that_only_begins_like_stop_is_none(sentence: str) -> None:
    assert command(sentence) == ""


@pytest.mark.parametrize(
    ("sentence", "intent"),
    [
        ("please pause", "pause"),
        ("pause the patrol", "pause"),
        ("hold on", "pause"),
        ("hold", "hold"),
        ("go home please", "go_home"),
        ("could you go back to the base", "go_home"),
        ("go back", ""),
        ("begin patrol", "patrol"),
        ("carry on", "resume"),
        ("keep going", "resume"),
        ("cancel the task", "end_task"),
        ("cancel", "no"),
        ("never mind", "no"),
        ("take a photo", "snapshot"),
        ("take control", "take_control"),
        ("take off", "take_off"),
        ("next camera", "camera"),
        ("not so fast", "slower"),
        ("lights on", "lights_on"),
        ("turn the lights off", "lights_off"),
        ("lights", "lights"),
        ("go back to the charging station", "dock"),
        ("what's the battery level", "tell_battery"),
        ("what are you doing", "tell_task"),
        ("don't move", "stop"),
    ],
)
def test_own_words_mean_the_command_that_they_say(sentence: str, intent: str) -> None:
    assert command(sentence) == intent


def test_the_phrase_is_the_command_without_politeness() -> None:
    assert understand("okay robot could you please go home now, thanks") == Meaning("go_home", "go home")


def test_every_intent_of_the_grammar_is_one_of_the_app() -> None:
    assert set(SENTENCES) <= set(INTENTS)
