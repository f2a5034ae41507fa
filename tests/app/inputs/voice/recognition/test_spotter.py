"""STOP in what is not yet said to its end."""

import pytest

from app.inputs.voice.audio.endpoint import Segment
from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.spotter import SEARCH_DELAYS, SEARCH_PERIOD, Spotter
from tests.app.inputs.voice.sounds import Written, voice

GRAMMAR = Grammar(COMMANDS)


def spotter(ipa, sure=0.9):
    model = Written(ipa, sure)
    return Spotter(GRAMMAR, model), model


@pytest.mark.parametrize(
    "ipa", ["s t ɑ p", "h eɪ j u s t ɑ p", "s t ɑ p ɪ t n aʊ", "ɪ m ɝ d͡ʒ ə n s i s t ɑ p"]
)
def test_stop_is_found_whatever_is_said_before_and_after_it(ipa):
    found = spotter(ipa)[0].find(voice(1.0), 10.0)
    assert found.command == "stop"


@pytest.mark.parametrize("ipa", ["s t ɑ ɹ t", "s p i d ʌ p", "p ɔ z", "ʃ ɑ p", "h ɛ l oʊ", "t ɑ ɹ ɡ ɛ t"])
def test_what_is_like_stop_is_not_stop(ipa):
    assert spotter(ipa)[0].find(voice(1.0), 10.0) is None


@pytest.mark.parametrize(
    "ipa", ["s t ɑ m p", "s t æ b", "ɑ n t ɑ p ə v ɪ t", "ɪ n ð ʌ ʃ ɑ p", "s t ɛ p oʊ v ɝ"]
)
def test_neighbours_of_stop_amid_other_words_are_not_stop(ipa):
    assert not any(spotter(ipa, sure)[0].find(voice(1.0), 10.0) for sure in (0.9, 0.5))


def test_stop_may_be_less_clear_at_its_end_than_at_its_beginning():
    assert spotter("s t ɑ", sure=0.6)[0].find(voice(1.0), 10.0) is not None
    assert spotter("t ɑ p", sure=0.6)[0].find(voice(1.0), 10.0) is None


def test_nothing_is_spotted_in_less_than_anybody_says_stop_in():
    assert spotter("s t ɑ p")[0].find(voice(0.1), 10.0) is None


def test_the_model_runs_when_the_voice_sinks_and_rarely_while_it_goes_on():
    spot, model = spotter("h ɛ l oʊ")
    now = 5.0
    while now < 6.0:
        now += 0.05
        spot.search(Segment(voice(now - 5.0 + 0.3), 5.0, now), now)
    assert model.asked <= 1.0 / SEARCH_PERIOD + 1
    asked = model.asked
    for number in range(10):
        spot.search(Segment(voice(1.3), 5.0, now), now + SEARCH_DELAYS[0] + number * 0.05)
    assert model.asked - asked == len(SEARCH_DELAYS)


def test_a_grammar_without_urgent_intents_is_never_looked_at():
    model = Written("s t ɑ p")
    assert Spotter(Grammar(COMMANDS, urgent=frozenset()), model).find(voice(1.0), 1.0) is None
    assert not model.asked
