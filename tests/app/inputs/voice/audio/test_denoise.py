"""Noise taken out of words."""

import numpy as np
import pytest

from app.inputs.voice.audio.denoise import MIN_GAIN, WINDOW, denoised
from app.inputs.voice.audio.noise import RATE, decibels
from tests.app.inputs.voice.sounds import quiet, voice


def word(noise):
    """A second with a voice in its middle third, and the noise alone."""
    rng = np.random.default_rng(4)
    about = (noise * rng.standard_normal(RATE)).astype(np.float32)
    said = np.zeros(RATE, np.float32)
    said[5000:11000] = voice(6000 / RATE)
    return said, about


def test_what_is_no_voice_grows_fainter_and_the_voice_stays():
    said, noise = word(0.05)
    clean = denoised(said + noise)
    assert decibels(clean[:4000]) < decibels(noise[:4000]) - 12.0
    assert decibels(clean[6000:10000]) == pytest.approx(decibels(said[6000:10000]), abs=1.0)


def test_words_are_nearer_to_themselves_than_with_their_noise():
    said, noise = word(0.05)
    clean = denoised(said + noise)
    assert np.square(clean - said).sum() < 0.3 * np.square(noise).sum()


def test_something_stays_of_everything():
    said, noise = word(0.05)
    left = decibels(denoised(said + noise)[1000:3000]) - decibels(noise[1000:3000])
    assert left == pytest.approx(20 * np.log10(MIN_GAIN), abs=2.5)


def test_it_is_as_long_as_before_and_not_shifted():
    said, noise = word(0.0)
    clean = denoised(said + noise + quiet(1.0, 1e-5))
    assert len(clean) == len(said)
    assert np.abs(np.correlate(clean, said, "full")).argmax() == len(said) - 1


@pytest.mark.parametrize("samples", [np.zeros(0, np.float32), voice(0.01), np.zeros(RATE, np.float32)])
def test_nothing_and_very_little_are_left_as_they_are(samples):
    assert len(samples) < WINDOW or not samples.any()
    assert np.array_equal(denoised(samples), samples)
