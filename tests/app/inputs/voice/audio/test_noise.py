"""How loud it is, and where nobody can be understood."""

import math

import numpy as np
import pytest

from app.inputs.voice.audio.noise import SWITCH_TIME, TOO_LOUD, NoiseMeter, decibels
from app.inputs.voice.audio.sound_files import chunks
from tests.app.inputs.voice.sounds import quiet, voice


def heard(*parts):
    meter = NoiseMeter()
    for part, at in chunks(np.concatenate(parts)):
        meter.feed(part, at)
    return meter


def test_a_full_sine_is_three_decibels_below_full_scale():
    at = np.arange(16000) / 16000
    assert decibels(np.sin(2 * np.pi * 440 * at).astype(np.float32)) == pytest.approx(-3.0, abs=0.05)


def test_silence_has_no_level():
    assert decibels(np.zeros(10, np.float32)) == -math.inf
    assert math.isnan(NoiseMeter().noise)


def test_the_noise_is_what_is_left_between_the_words():
    assert heard(quiet(1.0, 0.01), voice(0.5), quiet(1.0, 0.01)).noise == pytest.approx(-40.0, abs=1.5)


def test_words_stand_over_the_noise_by_their_ratio():
    meter = heard(quiet(2.0, 0.01))
    assert meter.heard(voice(0.5, 0.3) + quiet(0.5, 0.01)) == pytest.approx(27.0, abs=3.0)


def known(*parts):
    """A meter that has heard a voice of -17 dB in quiet, and then these."""
    meter = heard(quiet(1.0))
    meter.heard(voice(0.5, 0.3))
    for part, at in chunks(np.concatenate(parts), 1.0):
        meter.feed(part, at)
    return meter


def test_before_any_voice_was_heard_no_noise_is_too_loud_for_it():
    assert math.isnan(heard(quiet(9.0, 0.2)).snr)
    assert not heard(quiet(9.0, 0.2)).too_loud


def test_loud_noise_that_lasts_is_too_loud_and_quiet_that_lasts_is_not():
    assert not known(quiet(1.0)).too_loud
    assert not known(quiet(2.0), quiet(SWITCH_TIME - 0.5, 0.2)).too_loud
    assert known(quiet(9.0, 0.2)).too_loud
    assert not known(quiet(9.0, 0.2), quiet(9.0)).too_loud


def test_who_speaks_up_is_known_to_be_louder_at_once():
    meter = known(quiet(9.0, 0.2))
    meter.heard(voice(0.5, 0.9) + quiet(0.5, 0.2))
    assert meter.snr > TOO_LOUD


def test_what_was_found_before_the_ears_were_closed_holds_until_it_is_heard_anew():
    for noise, loud in ((0.2, True), (1e-3, False)):
        meter = known(quiet(9.0, 0.2))
        meter.rest()
        assert meter.too_loud
        for part, at in chunks(quiet(SWITCH_TIME + 0.2, noise), 20.0):
            meter.feed(part, at)
        assert meter.too_loud == loud


def test_it_is_not_switched_while_somebody_speaks():
    meter = known(quiet(1.0))
    for part, at in chunks(quiet(9.0, 0.2), 2.0):
        meter.feed(part, at, speaking=True)
    assert not meter.too_loud


def test_a_microphone_that_clips_is_told():
    assert heard(quiet(0.5), np.ones(1600, np.float32)).level().clipped
    assert not heard(quiet(0.5), voice(0.1)).level().clipped
