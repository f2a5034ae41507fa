"""Synthetic voices that speak given phrases, and noise."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import Samples, read, resampled

__all__ = ["NOISES", "Spoken", "espeak", "flite", "natural", "noise", "noisy"]

Spoken = tuple[str, Samples]
"""A phrase, and its sound at 16 kHz."""
SPEEDS = (0.85, 1.0, 1.2)
SIZES = (0.88, 1.0, 1.12)
"""Of the speaker: pitch and formants together."""
NOISES = ("pink", "wind", "motor")
ACCENTS = ("en-us", "en-gb", "en-gb-scotland", "en-us+f3", "en-gb+m3", "en-us+m7")


def natural(texts: Sequence[str]) -> list[Spoken]:
    """Every natural voice that is installed says each text; at least hibari's."""
    import hibari

    voice: Callable[..., Any] = hibari.Hibari()
    spoken: list[Spoken] = []
    for text in texts:
        for speed in SPEEDS:
            sound = np.asarray(voice(text, speed=speed, seed=1), np.float32)
            sizes = SIZES if speed == 1.0 else (1.0,)
            spoken += [(text, _trimmed(resampled(sound, 24000 * size))) for size in sizes]
    return [*spoken, *flite(texts)]


def flite(texts: Sequence[str], voices: Sequence[str] = ("rms", "kal16")) -> Iterator[Spoken]:
    """flite's voices; none where it is not installed."""
    program = shutil.which("flite")
    if program is None:
        return
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "said.wav"
        for voice in voices:
            for text in texts:
                subprocess.run([program, "-voice", voice, "-t", text, str(path)], check=True)
                yield text, _trimmed(read(path))


def espeak(texts: Sequence[str], accents: Sequence[str] = ACCENTS) -> list[Spoken]:
    """espeak-ng's formant voices, each all the texts; none where it is not installed."""
    try:
        import espeakng_loader
    except ImportError:
        return []
    library = ctypes.CDLL(espeakng_loader.get_library_path())
    rate = library.espeak_Initialize(2, 0, os.fsencode(espeakng_loader.get_data_path()), 0)
    heard: list[Samples] = []

    @ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.c_void_p)
    def take(samples: Any, count: int, _: object) -> int:
        if samples and count > 0:
            heard.append(np.ctypeslib.as_array(samples, (count,)).astype(np.float32) / 32768.0)
        return 0

    library.espeak_SetSynthCallback(take)
    spoken = []
    for accent in accents:
        library.espeak_SetVoiceByName(accent.encode())
        library.espeak_SetParameter(1, 150, 0)
        for text in texts:
            heard.clear()
            said = text.encode() + b"\0"
            library.espeak_Synth(said, ctypes.c_size_t(len(said)), 0, 1, 0, 1, None, None)
            library.espeak_Synchronize()
            spoken.append((text, _trimmed(resampled(np.concatenate(heard), rate))))
    library.espeak_Terminate()
    return spoken


def noisy(samples: Samples, kind: str, snr: float, rng: np.random.Generator) -> Samples:
    """The samples in noise of a kind of `NOISES`, `snr` [dB] below the loud parts in them."""
    loud = samples[np.abs(samples) > 0.02 * np.abs(samples).max()]
    power = float(np.sqrt(np.mean(np.square(loud))))
    sound = noise(kind, len(samples), rng)
    added: Samples = (samples + sound * power * 10 ** (-snr / 20)).astype(np.float32)
    return added


def noise(kind: str, count: int, rng: np.random.Generator) -> Samples:
    """Noise of a kind of `NOISES`, of power 1."""
    frequencies = np.fft.rfftfreq(count, 1 / RATE)
    frequencies[0] = 1.0
    white = np.fft.rfft(rng.standard_normal(count))
    if kind == "pink":
        sound = np.fft.irfft(white / np.sqrt(frequencies), count)
    elif kind == "wind":
        places = np.arange(0, count + RATE, RATE // 4)
        gusts = np.interp(np.arange(count), places, np.abs(rng.standard_normal(len(places))) + 0.2)
        sound = np.fft.irfft(white / frequencies * (frequencies < 300), count) * gusts
    else:
        at = np.arange(count) / RATE
        turns = [np.sin(2 * np.pi * (95 * k * at + rng.uniform())) / k**0.7 for k in range(1, 26)]
        sound = np.sum(turns, axis=0) + 0.3 * rng.standard_normal(count)
    level: Samples = (sound / np.sqrt(np.mean(np.square(sound)))).astype(np.float32)
    return level


def _trimmed(samples: Samples) -> Samples:
    """As loud as a voice at arm's length, a quarter of a second of silence before it, and 0.4 s after it."""
    loud = np.flatnonzero(np.abs(samples) > 0.01 * np.abs(samples).max())
    kept = samples[loud[0] : loud[-1] + 1] if len(loud) else samples
    kept = 0.4 * kept / max(1e-6, float(np.abs(kept).max()))
    return np.concatenate((np.zeros(4000, np.float32), kept, np.zeros(6400, np.float32))).astype(np.float32)
