"""Words of a recogniser that knows no grammar become the command that they sound like, or none."""

from __future__ import annotations

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.matching import interpret, match, said_within
from app.inputs.voice.recognition.phrases import LANGUAGES, PHRASES
from app.inputs.voice.recognition.sentences import Meaning

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


def test_a_guess_that_forbids_it_forbids_it_though_a_better_one_does_not() -> None:
    found = interpret(["go home", "don't go home"], ENGLISH)
    assert isinstance(found, Meaning)
    assert (found.command, found.negated) == ("go_home", True)


def test_a_guess_without_the_not_of_the_likeliest_is_no_command() -> None:
    assert interpret(["don't gnome", "go home"], ENGLISH) == []
    assert interpret(["no home"], ENGLISH) == [], "its sounds are nearly those of go home"


def test_stop_counts_though_another_guess_forbids_it() -> None:
    found = interpret(["stop", "do not go home"], ENGLISH)
    assert not isinstance(found, Meaning)
    assert found[0].command == "stop"


def test_what_no_sentence_explains_goes_by_its_sounds() -> None:
    found = interpret(["go hum"], ENGLISH)
    assert not isinstance(found, Meaning)
    assert [one.command for one in found] == ["go_home"]


def test_another_language_goes_by_its_phrases_alone() -> None:
    found = interpret(["nach hause"], Grammar(PHRASES["de"], "de"))
    assert not isinstance(found, Meaning)
    assert found[0].command == "go_home"
