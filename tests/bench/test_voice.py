"""The bench of voice finds its recordings."""

from __future__ import annotations

import wave
from pathlib import Path

import pytest

from bench.voice import recordings


def record(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(16000)
        file.writeframes(b"\x10\x00" * 160)


@pytest.mark.parametrize("above", [".", "speech_commands"])
def test_recordings_are_found_by_their_words_in_the_folder_and_in_the_one_of_the_collection(
    tmp_path: Path, above: str
) -> None:
    for word in ("stop", "House"):
        record(tmp_path / above / word / "one.wav")
    record(tmp_path / above / "walking" / "one.txt")
    found = [(clip.command, clip.said, len(clip.samples)) for clip in recordings(tmp_path)]
    assert sorted(found) == [("", "house", 160), ("stop", "stop", 160)]


def test_other_recordings_beside_the_collection_are_no_words(tmp_path: Path) -> None:
    record(tmp_path / "speech_commands" / "go" / "one.wav")
    record(tmp_path / "handwaving" / "one.wav")
    assert [clip.said for clip in recordings(tmp_path)] == ["go"]
