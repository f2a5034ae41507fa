"""Other looks at the same words, for a model that was trained on other people, other rooms and other microphones.

Each errs elsewhere, and what is common to them is what was said: with less noise, and of a speaker that is a little smaller or
larger. All of them as loud as the model likes it.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.denoise import denoised
from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import resampled

__all__ = ["levelled", "looks"]

LOUD = 0.1
"""How loud the words are made: root mean square of what is loud in them [of full scale]."""
FRAME, LOUDEST = 320, 0.9
"""Loudness is that of 20 ms [samples] that so many of the others are below."""
SILENCE = 1e-5
"""What is more quiet is not made louder than this would be [of full scale]."""
SIZES = (1.08, 0.93)
"""Pitch, formants and speed by so much together: about what people differ by."""


def looks(samples: NDArray[np.float32]) -> Iterator[NDArray[np.float32]]:
    """One after the other, at 16 kHz, -1 to 1."""
    level = levelled(samples)
    yield denoised(level)
    for size in SIZES:
        yield resampled(level, RATE * size)


def levelled(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """The same words as loud as the model likes them; as they are where they are shorter than 20 ms."""
    frames = samples[: len(samples) // FRAME * FRAME].reshape(-1, FRAME)
    if not len(frames):
        return samples
    loud = float(np.quantile(np.sqrt(np.mean(np.square(frames), axis=1)), LOUDEST))
    level: NDArray[np.float32] = np.clip(samples * (LOUD / max(SILENCE, loud)), -1.0, 1.0).astype(np.float32)
    return level
