"""Phrases, and how it sounds."""

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar, VoiceTrouble
from app.inputs.voice.recognition.lexicon import COMMANDS, PHONES, WORDS, background, pronunciations, spell
from app.intents.intents import INTENTS


def test_every_phrase_of_every_intent_can_be_pronounced():
    assert all(pronunciations(phrase) for phrases in COMMANDS.values() for phrase in phrases)


def test_what_is_said_are_intents_of_the_app():
    assert set(COMMANDS) <= set(INTENTS)


def test_stop_yes_and_no_can_be_said():
    assert {"stop", "yes", "no"} <= set(COMMANDS)


def test_no_two_intents_sound_the_same():
    seen = {}
    for command, phrases in COMMANDS.items():
        for phrase in phrases:
            for sounds in pronunciations(phrase):
                assert seen.setdefault(sounds, command) == command


def test_a_word_with_two_pronunciations_gives_a_phrase_with_both():
    assert len(pronunciations("start task")) == len(WORDS["start"]) * len(WORDS["task"])


def test_a_word_that_nobody_wrote_down_is_said_with_those_that_are_known():
    with pytest.raises(VoiceTrouble, match=r"'fandango' sounds is not known; say it in a, camera"):
        pronunciations("fandango")


def test_a_sound_that_is_none_is_said():
    with pytest.raises(VoiceTrouble, match="'q' is no sound"):
        spell("s q")


def test_background_words_are_spelt_in_known_sounds_and_are_no_commands():
    words = dict(background())
    assert len(words) > 300
    assert all(sound in PHONES for sounds in words.values() for sound in sounds)
    ours = {
        sounds for phrases in COMMANDS.values() for phrase in phrases for sounds in pronunciations(phrase)
    }
    assert not ours & set(words.values())


def test_a_grammar_without_a_phrase_is_refused():
    with pytest.raises(ValueError, match="at least one phrase"):
        Grammar({})
