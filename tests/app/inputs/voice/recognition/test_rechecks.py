"""Other looks at the same words."""

import numpy as np
import pytest

from app.inputs.voice.recognition.rechecks import LOUD, levelled, looks
from tests.app.inputs.voice.sounds import quiet, voice


def rms(samples):
    return float(np.sqrt(np.mean(np.square(samples))))


@pytest.mark.parametrize("level", [0.003, 0.03, 0.3, 1.0])
def test_however_loud_somebody_speaks_the_words_are_as_loud_as_the_model_likes_them(level):
    assert rms(levelled(voice(0.6, level))) == pytest.approx(LOUD, rel=0.4)


def test_nothing_is_louder_than_full_scale_and_silence_stays_silent():
    click = quiet(0.5, 1e-4)
    click[4000] = 1.0
    assert np.abs(levelled(click)).max() <= 1.0
    assert not levelled(np.zeros(8000, np.float32)).any()


def test_what_is_shorter_than_a_look_stays_as_it_is():
    assert levelled(quiet(0.01)).tolist() == quiet(0.01).tolist()


def test_one_look_is_as_long_and_the_others_are_of_a_smaller_and_a_larger_speaker():
    words = voice(0.5)
    assert [len(look) / len(words) for look in looks(words)] == pytest.approx([1.0, 0.926, 1.075], abs=0.01)


def test_however_loud_somebody_speaks_every_look_is_the_same():
    words = np.concatenate((quiet(0.3), voice(0.6), quiet(0.3)))
    for look, soft in zip(looks(words), looks(0.02 * words), strict=True):
        assert np.allclose(look, soft, atol=1e-3)


def test_even_nothing_has_looks():
    assert [len(look) for look in looks(np.zeros(0, np.float32))] == [0, 0, 0]
