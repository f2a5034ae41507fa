"""Short tones for the steps of the mark, made here and played by Kivy where the system can; silent where it cannot.

tones = Tones(); tones.play("step"); tones.close()
"""

from __future__ import annotations

import logging
import math
import struct
import tempfile
import wave
from collections.abc import Mapping
from pathlib import Path
from typing import Any

__all__ = ["TONES", "Tones", "write"]

log = logging.getLogger(__name__)

TONES = {
    "step": (660, 0.045),
    "back": (440, 0.07),
    "in": (760, 0.06),
    "act": (990, 0.11),
    "none": (220, 0.12),
}
"""What is heard to its frequency [Hz] and how long it lasts [s]."""
RATE = 22050
"""[Hz]"""
LOUD = 0.35
"""Of what is possible."""
FADE = 0.008
"""A tone comes and goes within so long: without it, it clicks [s]."""


class Tones:
    """Makes and loads each when it is first heard; nothing is open before."""

    def __init__(self, table: Mapping[str, tuple[float, float]] = TONES) -> None:
        """`table` names each tone with its frequency [Hz] and how long it lasts [s]."""
        self._table = table
        self.volume = 1.0
        """Of what the file has, 0 to 1."""
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._sounds: dict[str, Any] = {}
        self.silent = False
        """Nothing here can be heard: tried once, and not again."""

    def play(self, name: str) -> None:
        """Begin it, from its beginning; KeyError for a tone that there is not."""
        if name not in self._sounds:
            self._sounds[name] = None if self.silent else self._load(name)
        sound = self._sounds[name]
        if sound is not None:
            sound.stop()
            sound.volume = self.volume
            sound.play()

    def close(self) -> None:
        """Let go of every sound and file."""
        for sound in self._sounds.values():
            if sound is not None:
                sound.unload()
        self._sounds.clear()
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def _load(self, name: str) -> Any:
        from kivy.core.audio import SoundLoader

        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="pilothouse-tones-")
        path = Path(self._folder.name, f"{name}.wav")
        write(path, *self._table[name])
        try:
            sound = SoundLoader.load(str(path))
        except Exception as problem:  # noqa: BLE001 - whatever a sound system fails with, the mark moves on without it
            log.warning("There is no sound: %s", problem)
            sound = None
        self.silent = sound is None or not sound.length > 0
        return None if self.silent else sound


def write(path: Path, frequency: float, seconds: float) -> None:
    """A sine of `frequency` [Hz] as a WAV file of 16 bit, one channel."""
    count = round(RATE * seconds)
    frames = bytearray()
    for index in range(count):
        edge = min(index, count - index) / RATE / FADE
        value = LOUD * min(1.0, edge) * math.sin(2 * math.pi * frequency * index / RATE)
        frames += struct.pack("<h", round(32767 * value))
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(bytes(frames))
