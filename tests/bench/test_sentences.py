"""The bench of sentences counts rightly, and no sentence of its file moves a robot that was not meant to move."""

from __future__ import annotations

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.matching import Match, interpret
from app.inputs.voice.recognition.phrases import PHRASES
from app.inputs.voice.recognition.sentences import Meaning
from bench.sentences import NOTHING, judge, sentences, shares


def test_there_are_300_sentences_of_which_60_mean_nothing_and_none_twice() -> None:
    said = sentences()
    assert len(said) >= 300
    assert sum(intent == NOTHING for intent, _ in said) >= 60
    assert len({words.casefold() for _, words in said}) == len(said)


def test_one_that_takes_everything_for_go_home_is_wrong_and_moving() -> None:
    figures = shares(lambda _, __: [Match("go_home", "go home", 1.0, "")])
    homeward = sum(intent == "go_home" for intent, _ in sentences())
    assert figures["wrong_moving"] == figures["wrong"] == 1 - homeward / len(sentences())


def test_what_waits_for_a_question_or_for_other_words_is_asked_again() -> None:
    assert judge(lambda _, __: Meaning("go_home", "go home", partly=True), "x") == ("asked_again", "")
    assert judge(lambda _, __: Meaning("go_home", "go home", negated=True), "x") == ("refused", "")
    assert judge(lambda _, __: [Match("no", "cancel", 1.0, "")], "x") == ("asked_again", "")


def test_no_sentence_moves_a_robot_that_was_not_meant_to_move() -> None:
    figures = shares(interpret)
    assert figures["wrong_moving"] == figures["wrong"] == 0
    assert figures["understood"] >= 0.7


def test_no_sentence_that_means_nothing_is_a_command_wherever_it_stands_among_the_guesses() -> None:
    grammar = Grammar(PHRASES["en"])
    for intent, words in sentences():
        if intent == NOTHING:
            found = interpret([words, words.upper()], grammar)
            assert isinstance(found, Meaning) or not found, words
