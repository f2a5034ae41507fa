"""STOP in what is not yet said to its end."""

import math

import numpy as np
import pytest

from app.inputs.voice.audio.endpoint import Segment
from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.spotter import (
    LIKELY,
    RUNNING_PERIOD,
    SEARCH_DELAYS,
    SEARCH_PERIOD,
    SURE,
    Spotter,
)
from tests.app.inputs.voice.sounds import Written, quiet, voice

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


class Sure(Written):
    """Is as sure as that [log odds] that STOP ends at the frame before the last but five."""

    def __init__(self, odds, ipa="h ɛ l oʊ"):
        super().__init__(ipa)
        self.odds, self.looks = odds, 0

    def stop_ends(self, samples):
        self.looks += 1
        ends = np.full(len(self.table), -9.0, np.float32)
        ends[-6] = self.odds
        return ends


def heard(model, samples=None):
    return Spotter(GRAMMAR, model).running(voice(1.6) if samples is None else samples, 10.0)


def test_stop_in_running_sound_is_where_its_network_is_sure_and_when_it_says():
    found = heard(Sure(SURE + 0.1))
    assert (found.command, found.phrase, found.ended) == ("stop", "stop", pytest.approx(9.9))
    assert heard(Sure(SURE - 0.1)) is None


def test_where_it_is_less_sure_the_sounds_must_be_there_too():
    assert heard(Sure(LIKELY + 0.1, "s t ɑ p")) is not None
    assert heard(Sure(LIKELY + 0.1, "h ɛ l oʊ")) is None
    assert heard(Sure(LIKELY - 0.1, "s t ɑ p")) is None


def test_silence_is_not_looked_at_and_sound_is_ten_times_a_second_at_most():
    model = Sure(-9.0)
    spot = Spotter(GRAMMAR, model)
    spot.running(quiet(1.6, 1e-5), 1.0)
    assert not model.looks
    for number in range(21):
        spot.running(voice(1.6), 5.0 + 0.05 * number)
    assert model.looks == pytest.approx(1.0 / RUNNING_PERIOD, abs=1.0)


def test_time_that_begins_anew_is_looked_at_again():
    model = Sure(-9.0)
    spot = Spotter(GRAMMAR, model)
    spot.running(voice(1.6), 50.0)
    spot.running(voice(1.6), 1.0)
    assert model.looks == 2


def test_where_running_sound_is_listened_to_words_are_not_searched_again():
    model = Sure(-9.0, "s t ɑ p")
    spot = Spotter(GRAMMAR, model)
    spot.running(voice(1.6), 5.0)
    assert spot.search(Segment(voice(0.6), 4.4, 5.0), 5.0 + SEARCH_DELAYS[0]) is None
    assert not model.asked


def test_words_hold_stop_where_its_network_finds_it_likely_or_has_no_opinion():
    assert Spotter(GRAMMAR, Sure(LIKELY)).holds(voice(3.0))
    assert not Spotter(GRAMMAR, Sure(LIKELY - 0.1)).holds(voice(3.0))
    assert Spotter(GRAMMAR, Written("k æ t")).holds(voice(3.0))


def test_a_grammar_without_stop_listens_to_no_running_sound():
    model = Sure(9.0)
    spot = Spotter(Grammar(COMMANDS, urgent=frozenset()), model)
    assert spot.running(voice(1.6), math.pi) is None
    assert not model.looks
