"""Words of a recogniser that knows no grammar become the command that they sound like, or none."""

from __future__ import annotations

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.matching import match, said_within
from app.inputs.voice.recognition.phrases import LANGUAGES, PHRASES

ENGLISH = Grammar(PHRASES["en"])


@pytest.mark.parametrize(
    ("words", "command"),
    [("Stop!", "stop"), ("go hum", "go_home"), ("take of", "take_off"), ("Slow down", "slower")],
)
def test_what_sounds_like_a_command_is_one(words: str, command: str) -> None:
    assert match([words], ENGLISH)[0].command == command


@pytest.mark.parametrize(
    "words", ["shop", "star", "stomp", "guess", "house", "snow", "he stepped off the bus", ""]
)
def test_what_sounds_like_another_word_is_none(words: str) -> None:
    assert match([words], ENGLISH) == []


def test_of_two_that_fit_the_one_that_was_likelier_comes_first() -> None:
    found = match(["pause", "patrol", "pause"], ENGLISH)
    assert [one.command for one in found] == ["pause", "patrol"]
    assert match(["pause", "patrol"], ENGLISH, {"patrol"})[0].command == "patrol"


def test_accents_and_capitals_make_no_difference() -> None:
    spanish = Grammar(PHRASES["es"], "es")
    assert match(["Mas rapido"], spanish)[0].command == "faster"


@pytest.mark.parametrize(("words", "phrase"), [("please stop now", "stop"), ("stopping", ""), ("", "")])
def test_a_word_is_found_within_others_only_whole(words: str, phrase: str) -> None:
    assert said_within(words, ENGLISH, "stop") == phrase


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_language_says_every_command_and_no_two_alike(language: str) -> None:
    assert set(PHRASES[language]) == set(PHRASES["en"])
    grammar = Grammar(PHRASES[language], language)
    for command, phrases in PHRASES[language].items():
        for phrase in phrases:
            assert [one.command for one in match([phrase], grammar) if one.alike == 1.0] == [command]
