"""What stands between a voice and a microphone: motors, wind, music, noise, rooms and cheap loudspeakers, each drawn anew."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE

__all__ = ["NOISES", "Samples", "level_of", "noise", "resized", "through_a_room"]

Samples: TypeAlias = NDArray[np.float64]
Rng: TypeAlias = np.random.Generator

MAJOR, MINOR = (0, 2, 4, 5, 7, 9, 11, 12, 14, 16), (0, 2, 3, 5, 7, 8, 10, 12, 14, 15)
"""Steps of a scale in half tones."""
HIGHEST = 7500.0
"""Tone [Hz]."""


def noise(kind: str, count: int, rng: Rng) -> Samples:
    """`count` samples of a kind of `NOISES`, of power 1."""
    sound = NOISES[kind](count, rng)
    return sound / _rms(sound)


def level_of(sound: Samples) -> float:
    """The power of what is loud in it, as a level [1]."""
    loud = sound[np.abs(sound) > 0.02 * np.abs(sound).max()] if len(sound) else sound
    return _rms(loud)


def resized(sound: Samples, size: float) -> Samples:
    """As by a speaker so many times smaller: higher and faster."""
    count = int(len(sound) / size)
    return np.interp(np.arange(count) * size, np.arange(len(sound)), sound)


def through_a_room(sound: Samples, rng: Rng) -> Samples:
    """By another microphone, sometimes a narrow one, and in one of three with the echo of a room."""
    frequencies = np.fft.rfftfreq(len(sound), 1 / RATE)
    points = np.geomspace(60, RATE / 2, 7)
    gains = np.interp(np.log(np.maximum(frequencies, 1)), np.log(points), rng.normal(0, 3.0, 7))
    spectrum = np.fft.rfft(sound) * 10 ** (gains / 20)
    if rng.random() < 0.2:
        spectrum = spectrum * (frequencies < rng.uniform(3300, 7000))
    if rng.random() < 0.15:
        spectrum = spectrum * (frequencies > rng.uniform(80, 350))
    heard = np.fft.irfft(spectrum, len(sound))
    return _echoing(heard, rng) if rng.random() < 0.35 else heard


def _echoing(sound: Samples, rng: Rng) -> Samples:
    count = int(RATE * rng.uniform(0.05, 0.4))
    echo = rng.standard_normal(count) * np.exp(-np.arange(count) / count * 6.9 * rng.uniform(0.6, 1.2))
    echo *= rng.uniform(0.05, 0.5) / np.sqrt(np.sum(np.square(echo)))
    echo[0] += 1.0
    size = 1 << int(np.ceil(np.log2(len(sound) + count)))
    return np.fft.irfft(np.fft.rfft(sound, size) * np.fft.rfft(echo, size), size)[: len(sound)]


def _rms(sound: Samples) -> float:
    return float(np.sqrt(np.mean(np.square(sound)) + 1e-12))


def _hiss(count: int, rng: Rng, slope: float, low: float = 0.0, high: float = RATE / 2) -> Samples:
    """Noise that falls with the frequency to the power of `slope`, between two of them [Hz]."""
    frequencies = np.fft.rfftfreq(count, 1 / RATE)
    frequencies[0] = frequencies[1]
    within = (frequencies >= low) & (frequencies <= high)
    return np.fft.irfft(np.fft.rfft(rng.standard_normal(count)) * frequencies**-slope * within, count)


def _motor(count: int, rng: Rng) -> Samples:
    """Overtones of a speed that sways and drifts, and hiss."""
    at = np.arange(count) / RATE
    turns, falling = rng.uniform(35, 260), rng.uniform(0.3, 1.4)
    sway = rng.uniform(0, 0.06) * np.sin(2 * np.pi * rng.uniform(0.05, 1.5) * at + rng.uniform(0, 6))
    phase = 2 * np.pi * np.cumsum(turns * (1 + sway + rng.uniform(-0.1, 0.1) * at / max(1.0, at[-1]))) / RATE
    sound = np.zeros(count)
    for overtone in range(1, 1 + min(int(rng.integers(6, 40)), int(HIGHEST / turns))):
        sound += np.sin(overtone * phase + rng.uniform(0, 6)) * overtone**-falling * rng.uniform(0.3, 1.5)
    sound *= (1 + rng.uniform(0, 0.4) * np.sin(2 * np.pi * rng.uniform(1, 20) * at)) / _rms(sound)
    hiss = _hiss(count, rng, rng.uniform(0, 0.6))
    return sound + rng.uniform(0.05, 0.9) * hiss / _rms(hiss)


def _wind(count: int, rng: Rng) -> Samples:
    """Gusts of low noise."""
    places = np.arange(0, count + RATE, RATE // int(rng.integers(2, 7)))
    gusts = np.interp(np.arange(count), places, np.abs(rng.standard_normal(len(places))) + 0.15)
    return _hiss(count, rng, rng.uniform(0.6, 1.3), high=rng.uniform(200, 900)) * gusts


def _music(count: int, rng: Rng) -> Samples:
    """Chords of a scale on a beat, and drums."""
    sound = np.zeros(count)
    steps = np.array(MAJOR if rng.random() < 0.6 else MINOR)
    beat, root, at = rng.uniform(0.2, 0.6), rng.uniform(80, 250), 0.0
    while at < count / RATE:
        first = int(at * RATE)
        size = min(count - first, int(RATE * rng.uniform(0.3, 1.2)))
        sound[first : first + size] += _chord(size, root * 2 ** (steps / 12), rng)
        drum = min(size, 2400)
        if drum > 64 and rng.random() < 0.6:
            fading = np.exp(-np.arange(drum) / rng.uniform(200, 1200))
            sound[first : first + drum] += (
                rng.uniform(0.3, 2) * _hiss(drum, rng, rng.choice([0.0, 1.0])) * fading
            )
        at += beat * rng.choice([0.5, 1, 1, 2])
    return sound


def _chord(count: int, scale: Samples, rng: Rng) -> Samples:
    at, sound = np.arange(count) / RATE, np.zeros(count)
    fading = np.exp(-at * rng.uniform(1, 6))
    for _ in range(int(rng.integers(1, 4))):
        tone = rng.choice(scale) * rng.choice([1, 2, 4])
        for overtone in range(1, 1 + min(int(rng.integers(1, 8)), int(HIGHEST / tone))):
            sound += np.sin(2 * np.pi * tone * overtone * at) * fading / overtone ** rng.uniform(0.7, 2)
    return sound


NOISES: dict[str, Callable[[int, Rng], Samples]] = {
    "motor": _motor,
    "wind": _wind,
    "music": _music,
    "pink": lambda count, rng: _hiss(count, rng, 0.5),
    "white": lambda count, rng: _hiss(count, rng, rng.uniform(-0.2, 0.3)),
    "brown": lambda count, rng: _hiss(count, rng, 1.0),
}
"""Kinds of noise."""
