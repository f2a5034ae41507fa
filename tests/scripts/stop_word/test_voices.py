"""The voices of the training, and what is kept of them."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from scripts.stop_word import voices
from scripts.stop_word.__main__ import HELD
from scripts.stop_word.phrases import Phrase
from scripts.stop_word.voices import VOICES, load, speak

JUDGES = {
    "adam",
    "michael",
    "belinda",
    "benjamin",
    "travis",
    "victor",
    "anika",
    "quincy",
    "rms",
    "awb",
    "slt",
}
"""Of `bench/stop_word.py` and of other judges."""


def test_what_a_voice_said_is_read_as_it_was_without_silence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    speeds: list[float] = []

    def say(text: str, speed: float) -> NDArray[np.float32]:
        speeds.append(speed)
        tone = np.sin(np.arange(8000) * 0.1) * 0.2 if text else np.zeros(8000)
        return np.concatenate((np.zeros(4000), tone, np.zeros(4000))).astype(np.float32)

    monkeypatch.setitem(voices.VOICES, "somebody", lambda: say)
    path = tmp_path / "somebody.voice.npz"
    seconds = speak(
        "somebody", [Phrase("alone", "stop"), Phrase("near", ""), Phrase("prose", "We came.")], path, 1
    )
    assert seconds == 3.0
    said = load(path)
    assert [one.kind for one in said] == ["alone", "prose"], "silence is nothing that was said"
    assert len(said[0].sound) == pytest.approx(8000 + 480, abs=20)
    assert np.abs(said[0].sound).max() == pytest.approx(0.5, abs=0.01)
    assert len(set(speeds)) > 1


def test_a_program_that_is_not_there_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(OSError, match="The program flite is not installed"):
        VOICES["kal"]()


def test_nobody_who_judges_has_spoken_for_it() -> None:
    assert set(HELD) < set(VOICES)
    assert not [name for name in VOICES if name.split("+")[-1] in JUDGES]
