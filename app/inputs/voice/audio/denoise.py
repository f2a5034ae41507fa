"""Noise taken out of words: a Wiener gain by the noise that is heard where they are not.

For a second look beside the first, never in place of it: what is taken out leaves traces that the recogniser's model was not
trained on, but it errs elsewhere than the noise makes it err.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["denoised"]

WINDOW, STEP = 512, 128
"""Looked at together, and from one to the next: 32 ms and 8 ms [samples]."""
QUIET_SHARE = 0.25
"""So many of the windows, the most quiet ones, are taken for noise alone: there is silence before and after words."""
SMOOTHED_BINS = 5
"""The noise is smoothed over so many frequencies: a quarter of a second knows it no better."""
RATIO_KEPT = 0.96
"""How much the ratio of speech to noise keeps from one window to the next (decision directed: Ephraim, Malah 1984): less makes music of the noise."""
MIN_GAIN = 0.15
"""So much stays of everything: what is silenced altogether sounds like no voice at all."""


def denoised(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """The same words, -1 to 1 at 16 kHz, in less noise; as they are where they are shorter than one window."""
    if len(samples) < WINDOW:
        return samples
    shape = np.sqrt(np.hanning(WINDOW + 1)[:WINDOW])
    around = np.concatenate((samples[:WINDOW][::-1], samples, samples[-WINDOW:][::-1], np.zeros(STEP)))
    starts = range(0, len(around) - WINDOW + 1, STEP)
    spectra = np.fft.rfft(np.stack([around[start : start + WINDOW] for start in starts]) * shape, axis=1)
    parts = np.fft.irfft(spectra * _gains(np.square(np.abs(spectra))), WINDOW, axis=1) * shape
    summed = np.zeros(len(around))
    for part, start in zip(parts, starts, strict=True):
        summed[start : start + WINDOW] += part
    overlap = WINDOW / STEP / 2
    found: NDArray[np.float32] = (summed[WINDOW : WINDOW + len(samples)] / overlap).astype(np.float32)
    return found


def _gains(powers: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of each window and frequency."""
    loudness = np.log(powers + 1e-12).mean(axis=1)
    quiet = np.argsort(loudness)[: max(4, int(QUIET_SHARE * len(powers)))]
    wide = np.pad(powers[quiet].mean(axis=0), SMOOTHED_BINS // 2, "edge")
    noise = np.convolve(wide, np.ones(SMOOTHED_BINS) / SMOOTHED_BINS, "valid") + 1e-12
    gains, kept = np.empty_like(powers), np.zeros(powers.shape[1])
    for number, ratio in enumerate(powers / noise):
        speech = RATIO_KEPT * kept + (1 - RATIO_KEPT) * np.maximum(ratio - 1.0, 0.0)
        gains[number] = gain = speech / (1.0 + speech)
        kept = np.square(gain) * ratio
    return np.maximum(gains, MIN_GAIN)
