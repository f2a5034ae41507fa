"""Noise, rooms and other speakers that training draws."""

from __future__ import annotations

import numpy as np
import pytest

from scripts.stop_word.disturbances import NOISES, level_of, noise, resized, through_a_room

RATE = 16000


@pytest.mark.parametrize("kind", NOISES)
def test_each_noise_has_power_1_and_is_drawn_anew(kind: str) -> None:
    rng = np.random.default_rng(1)
    first, second = noise(kind, 2 * RATE, rng), noise(kind, 2 * RATE, rng)
    assert np.sqrt(np.mean(np.square(first))) == pytest.approx(1.0, abs=0.01)
    assert not np.allclose(first, second)
    assert (first == noise(kind, 2 * RATE, np.random.default_rng(1))).all()


def test_the_level_is_of_what_is_loud() -> None:
    loud = np.sin(np.arange(RATE) * 0.3)
    assert level_of(np.concatenate((np.zeros(5 * RATE), loud))) == pytest.approx(0.71, abs=0.02)


def test_a_smaller_speaker_is_faster_and_higher() -> None:
    tone = np.sin(2 * np.pi * 400 * np.arange(RATE) / RATE)
    small = resized(tone, 1.25)
    assert len(small) == RATE / 1.25
    assert np.abs(np.fft.rfft(small)).argmax() * RATE / len(small) == pytest.approx(500, abs=3)


def test_a_room_changes_a_sound_and_not_how_long_it_is() -> None:
    sound, rng = np.random.default_rng(2).standard_normal(RATE), np.random.default_rng(3)
    for _ in range(20):
        heard = through_a_room(sound, rng)
        assert heard.shape == sound.shape
        assert np.isfinite(heard).all()
        assert not np.allclose(heard, sound)
