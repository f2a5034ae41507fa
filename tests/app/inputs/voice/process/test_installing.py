"""What the app says about packages of speech that are not there."""

from __future__ import annotations

from app.inputs.voice.process.installing import install_command
from app.inputs.voice.speech.tts import NO_ESPEAK, NO_HIBARI


def test_beside_the_sources_one_command_brings_all_of_speech(tmp_path):
    (tmp_path / "Makefile").touch()
    assert install_command("vosk", tmp_path) == "make voice"
    assert all("make voice" in sentence for sentence in (NO_HIBARI, NO_ESPEAK))


def test_an_installed_package_asks_pip_for_its_extra(tmp_path):
    assert install_command("vosk", tmp_path) == "pip install pilothouse[vosk]"
