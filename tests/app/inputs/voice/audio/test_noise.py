"""How loud it is, and where nobody can be understood."""

import math

import numpy as np
import pytest

from app.inputs.voice.audio.noise import SWITCH_TIME, NoiseMeter, decibels
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


def test_loud_noise_that_lasts_is_too_loud_and_quiet_that_lasts_is_not():
    assert not heard(quiet(1.0)).too_loud
    assert not heard(quiet(2.0), quiet(SWITCH_TIME - 0.5, 0.2)).too_loud
    assert heard(quiet(9.0, 0.2)).too_loud
    assert not heard(quiet(9.0, 0.2), quiet(9.0)).too_loud


def test_what_was_found_before_the_ears_were_closed_counts_again_once_it_is_heard_anew():
    still_loud, quiet_now = heard(quiet(9.0, 0.2)), heard(quiet(9.0, 0.2))
    for meter, noise, loud in ((still_loud, 0.2, True), (quiet_now, 1e-3, False)):
        meter.rest()
        assert (meter.too_loud, meter.outdated) == (True, True)
        for part, at in chunks(quiet(SWITCH_TIME + 0.2, noise), 20.0):
            meter.feed(part, at)
        assert (meter.too_loud, meter.outdated) == (loud, False)


def test_it_is_not_switched_while_somebody_speaks():
    meter = NoiseMeter()
    for part, at in chunks(quiet(9.0, 0.2)):
        meter.feed(part, at, speaking=True)
    assert not meter.too_loud


def test_a_microphone_that_clips_is_told():
    assert heard(quiet(0.5), np.ones(1600, np.float32)).level().clipped
    assert not heard(quiet(0.5), voice(0.1)).level().clipped
