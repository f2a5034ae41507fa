"""espeak-ng's library, the real one, makes samples of words."""

from __future__ import annotations

import numpy as np
import pytest

from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from app.inputs.voice.speech.espeak import EspeakLibrary, is_installed
from tests.lacking import package

package("espeakng_loader")


def test_words_become_a_sound_of_their_length() -> None:
    library = EspeakLibrary()
    short, long = library.samples("Go.", 1.0), library.samples("Go home to the charging station.", 1.0)
    assert is_installed()
    assert 0.2 < len(short) / library.sample_rate < 1.0
    assert len(long) > 3 * len(short)
    assert 0.05 < np.abs(long).max() <= 1.0


def test_faster_is_shorter() -> None:
    library = EspeakLibrary()
    usual, fast = (library.samples("Go home to the charging station.", rate) for rate in (1.0, 1.6))
    assert len(fast) < 0.8 * len(usual)


def test_one_voice_does_not_change_the_other() -> None:
    english, korean = EspeakLibrary(), EspeakLibrary("ko")
    before = english.samples("Go home?", 1.0)
    korean.samples("집", 1.0)
    assert len(english.samples("Go home?", 1.0)) == pytest.approx(len(before), rel=0.02)
    assert len(korean.samples("Go home?", 1.0)) != pytest.approx(len(before), rel=0.02)


def test_no_words_are_no_sound() -> None:
    assert not np.abs(EspeakLibrary().samples("", 1.0)).any()


def test_a_voice_that_there_is_not_is_said() -> None:
    with pytest.raises(VoiceTrouble, match="'nowhere'"):
        EspeakLibrary("nowhere")
