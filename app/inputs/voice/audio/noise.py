"""A noise meter: the level of speech, of the noise, and whether anybody can be understood there."""

from __future__ import annotations

import math
from collections import deque

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.interfaces.speech_recognizer import Level

__all__ = ["CLEAR", "RATE", "TOO_LOUD", "NoiseMeter", "decibels"]

RATE = 16000
"""Samples a second of everything that is heard [Hz]."""
FRAME_SAMPLES = 320
"""Samples that one level is of: 20 ms."""
TOO_LOUD, CLEAR = 6.0, 9.0
"""Voice goes off below this ratio of speech to noise and comes back above that one [dB]."""
SWITCH_TIME = 1.5
"""Noise must be too loud, or quiet again, for so long before anything is switched [s]."""
MIN_LEVEL = -90.0
"""Nothing is taken to be more quiet than this [dB over full scale]."""
CLIPPING_LEVEL = 0.985
"""Of full scale: a sample that is as loud was cut off."""
MAX_CLIPPED = 8
"""So many cut samples in a tenth of a second, and words are bent by it."""
NOISE_WINDOW = 5.0
"""The noise floor is the quiet end of what was heard in so many seconds [s]."""
QUIET_SHARE = 0.2
"""Its share of frames that are more quiet than the noise is taken to be."""


def decibels(samples: NDArray[np.float32]) -> float:
    """Level of the samples [dB over full scale]; -inf of silence and of none."""
    power = float(np.mean(np.square(samples, dtype=np.float64))) if len(samples) else 0.0
    return 10.0 * math.log10(power) if power > 0.0 else -math.inf


class NoiseMeter:
    """Listens along; tells the noise floor, the ratio of speech to it, and when that is too bad to understand anybody."""

    def __init__(self) -> None:
        self._frames: deque[float] = deque(maxlen=int(NOISE_WINDOW * RATE / FRAME_SAMPLES))
        self._rest: NDArray[np.float32] = np.zeros(0, np.float32)
        self._clipped: deque[int] = deque([0] * 5, maxlen=5)
        self._voice = math.nan
        self._since = math.nan
        self.too_loud = False
        """The voice that was heard last cannot be understood here; with hysteresis in ratio and in time. Louder words may be."""

    def feed(self, samples: NDArray[np.float32], at: float, *, speaking: bool = False) -> None:
        """The next samples, -1 to 1, the last one heard at `at` [s]; `speaking` when somebody is thought to talk."""
        heard = np.concatenate((self._rest, samples)) if len(self._rest) else samples
        whole = len(heard) // FRAME_SAMPLES * FRAME_SAMPLES
        for start in range(0, whole, FRAME_SAMPLES):
            frame = heard[start : start + FRAME_SAMPLES]
            self._frames.append(max(MIN_LEVEL, decibels(frame)))
            self._clipped.append(int(np.count_nonzero(np.abs(frame) >= CLIPPING_LEVEL)))
        self._rest = heard[whole:]
        self._judge(at, speaking=speaking)

    def rest(self) -> None:
        """The ears were closed: how loud it was then tells nothing of how loud it is when they open again."""
        self._frames.clear()
        self._rest = np.zeros(0, np.float32)
        self._since = math.nan

    def heard(self, samples: NDArray[np.float32]) -> float:
        """Words were said: remembers how loud, louder ones at once, and gives their ratio to the noise [dB]; NaN where no noise is known yet."""
        if len(samples) < FRAME_SAMPLES:
            return math.nan
        frames = samples[: len(samples) // FRAME_SAMPLES * FRAME_SAMPLES].reshape(-1, FRAME_SAMPLES)
        powers = np.mean(np.square(frames, dtype=np.float64), axis=1)
        loud = float(np.mean(powers[powers >= np.quantile(powers, 0.6)]))
        noise = self.noise
        clean = loud - (10 ** (noise / 10) if not math.isnan(noise) else 0.0)
        level = max(MIN_LEVEL, 10 * math.log10(max(clean, 1e-12)))
        self._voice = level if not level <= self._voice else 0.7 * self._voice + 0.3 * level
        return level - noise

    @property
    def noise(self) -> float:
        """Of what is no speech [dB over full scale]; NaN before anything was heard."""
        if not self._frames:
            return math.nan
        return float(np.quantile(np.array(self._frames), QUIET_SHARE))

    @property
    def snr(self) -> float:
        """How far the voice that was heard last would stand over the noise here [dB]; NaN before any was heard: people speak up in noise."""
        return self._voice - self.noise

    def level(self, *, speaking: bool = False) -> Level:
        """What a meter shows now."""
        last = list(self._frames)[-5:]
        loud = max(last) if last else -math.inf
        clipped = sum(self._clipped) >= MAX_CLIPPED
        return Level(loud, self.noise, self.snr, speaking=speaking, clipped=clipped)

    def _judge(self, at: float, *, speaking: bool) -> None:
        snr = self.snr
        if math.isnan(snr) or speaking:
            return
        changes = snr >= CLEAR if self.too_loud else snr < TOO_LOUD
        if not changes:
            self._since = math.nan
        elif math.isnan(self._since):
            self._since = at
        elif at - self._since >= SWITCH_TIME:
            self.too_loud, self._since = not self.too_loud, math.nan
