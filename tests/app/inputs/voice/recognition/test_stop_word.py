"""The network for the one word STOP."""

from __future__ import annotations

import numpy as np
import pytest

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import Samples, resampled
from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.conformer import WIDTH
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.model import HamaModel
from app.inputs.voice.recognition.rechecks import levelled
from app.inputs.voice.recognition.spotter import SURE, Spotter
from app.inputs.voice.recognition.stop_word import AFTER, BEFORE, StopWord, shipped
from tests.lacking import package

WIDE = 4


def made(seed: int = 1) -> StopWord:
    rng = np.random.default_rng(seed)
    weights = {"first": rng.standard_normal((WIDTH, WIDE)), "first_bias": np.zeros(WIDE)}
    for layer in range(3):
        weights |= {
            f"layer{layer}": rng.standard_normal((5 * WIDE, WIDE)),
            f"layer{layer}_bias": np.zeros(WIDE),
        }
    weights |= {"last": rng.standard_normal(WIDE), "last_bias": np.ones(1)}
    return StopWord({name: one.astype(np.float32) for name, one in weights.items()})


def frames(count: int) -> np.ndarray:
    return np.random.default_rng(2).standard_normal((count, WIDTH)).astype(np.float32)


def test_there_is_an_opinion_of_each_frame():
    assert made().ends(frames(30)).shape == (30,)


def test_it_is_of_what_was_before_and_a_little_of_what_comes():
    heard, other = frames(60), frames(60)
    other[40] += 5.0 * np.arange(WIDTH)
    changed = np.flatnonzero(~np.isclose(made().ends(heard), made().ends(other), atol=1e-6))
    assert changed.min() >= 40 - AFTER
    assert changed.max() <= 40 + BEFORE


def test_how_loud_the_frames_are_changes_nothing():
    assert np.allclose(made().ends(frames(30)), made().ends(3.0 * frames(30)), atol=1e-2)


def test_weights_of_another_network_are_told_from_its_own():
    with pytest.raises(KeyError):
        StopWord({"first": np.zeros((WIDTH, WIDE), np.float32)})


def said(text: str) -> Samples:
    package("hama")
    natural = package("hibari").Hibari()
    sound = resampled(np.asarray(natural(text, seed=1), np.float32), 24000)
    after = np.zeros(RATE // 10, np.float32)
    return np.concatenate((np.zeros(2 * RATE, np.float32), sound, after))[-int(1.6 * RATE) :]


@pytest.mark.parametrize(("text", "is_stop"), [("stop", True), ("house", False), ("pause", False)])
def test_the_one_that_is_shipped_knows_its_word(text, is_stop):
    assert shipped() is shipped()
    model, sound = HamaModel(), said(text)
    assert bool(model.stop_ends(levelled(sound)).max() > SURE) is is_stop
    # where it is less sure than that, the sounds of the word decide
    heard = Spotter(Grammar(COMMANDS), model).running(sound, 10.0)
    assert (heard is not None) is is_stop
