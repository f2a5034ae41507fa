"""Audio from files and from memory in place of a microphone: for tests, for a demonstration without one, and for the bench."""

from __future__ import annotations

import struct
import wave
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from widgets.core.language import tr

__all__ = ["CHUNK", "FileAudioSource", "Samples", "chunks", "read"]

Samples = NDArray[np.float32]

CHUNK = 800
"""Samples that a microphone gives at a time: 50 ms."""
RATES = (1000, 768000)
"""What recordings are made at [Hz]."""


def read(path: Path) -> Samples:
    """The file as mono samples at 16 kHz, -1 to 1: WAV by Python alone, FLAC, OGG and MP3 by miniaudio. `VoiceTrouble` otherwise."""
    try:
        return _wave(path) if path.suffix.lower() == ".wav" else _packed(path)
    except FileNotFoundError as problem:
        raise VoiceTrouble(tr("There is no recording {path}.").format(path=path)) from problem
    except (OSError, ValueError, EOFError, wave.Error, struct.error, ArithmeticError) as problem:
        raise VoiceTrouble(
            tr("{path} cannot be read as a recording: {problem}.").format(path=path, problem=problem)
        ) from problem


def chunks(samples: Samples, began: float = 0.0) -> Iterator[tuple[Samples, float]]:
    """As a microphone gives them that was opened at `began` [s]: samples and when the last of them was heard."""
    for start in range(0, len(samples), CHUNK):
        part = samples[start : start + CHUNK]
        yield part, began + (start + len(part)) / RATE


def resampled(samples: Samples, rate: float) -> Samples:
    """The same at 16 kHz; what is above 7.6 kHz is lost."""
    if rate == RATE or not len(samples):
        return samples.astype(np.float32)
    if rate > RATE:
        spectrum = np.fft.rfft(samples)
        spectrum[np.fft.rfftfreq(len(samples), 1 / rate) > 7600] = 0
        samples = np.fft.irfft(spectrum, len(samples)).astype(np.float32)
    count = round(len(samples) * RATE / rate)
    at = np.arange(count) * (rate / RATE)
    drawn: Samples = np.interp(at, np.arange(len(samples)), samples).astype(np.float32)
    return drawn


def _wave(path: Path) -> Samples:
    with wave.open(str(path), "rb") as file:
        width, rate, channels = file.getsampwidth(), file.getframerate(), file.getnchannels()
        raw = file.readframes(file.getnframes())
    if not RATES[0] <= rate <= RATES[1]:
        raise ValueError(
            tr("{rate} samples a second, where {rates} to {rates2} are read").format(
                rate=rate, rates=RATES[0], rates2=RATES[1]
            )
        )
    if width != 2:
        raise ValueError(tr("samples of {width} bits, where 16 are read").format(width=8 * width))
    samples = np.frombuffer(raw, "<i2").astype(np.float32) / 32768.0
    return resampled(samples[: len(samples) // channels * channels].reshape(-1, channels).mean(axis=1), rate)


def _packed(path: Path) -> Samples:
    try:
        import miniaudio
    except ImportError as problem:
        raise VoiceTrouble(
            tr("To read {suffix} the package miniaudio is needed.").format(suffix=path.suffix or path)
        ) from problem
    if not path.exists():
        raise FileNotFoundError(path)
    try:
        decoded = miniaudio.decode_file(str(path), nchannels=1, sample_rate=RATE)
    except miniaudio.MiniaudioError as problem:
        raise ValueError(str(problem)) from problem
    return np.array(decoded.samples, np.float32) / 32768.0


class FileAudioSource:
    """Ears that hear the given recordings one after the other, as fast as they are asked, then silence."""

    def __init__(self, recordings: Sequence[Samples], gap: float = 1.0) -> None:
        """`gap` is the silence after each [s]."""
        silence = np.zeros(int(gap * RATE), np.float32)
        parts = [part for recording in recordings for part in (recording, silence)]
        self._left = np.concatenate(parts) if parts else silence[:0]
        self._at = 0.0
        self.open = False

    def start(self) -> None:
        """Begin to hear."""
        self.open = True

    def read(self, timeout: float) -> tuple[Samples, float] | None:
        """The next 50 ms and when they ended, on a clock that begins at 0; None at the end."""
        part, self._left = self._left[:CHUNK], self._left[CHUNK:]
        if not self.open or not len(part):
            return None
        self._at += len(part) / RATE
        return part, self._at

    def stop(self) -> None:
        """Hear nothing more."""
        self.open = False
