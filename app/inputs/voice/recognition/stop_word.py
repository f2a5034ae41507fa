"""STOP in running sound: a small network on what the phoneme recogniser's network hears, before it decides for sounds.

144 numbers a frame ─ norm ─ 48 ─ three convolutions over 5 frames, each 1, 2 and 4 frames apart ─ how surely a word ends about here

`stop_word.npz` was trained with synthetic voices alone, in talk and noise (docs/voice.md tells which); `bench/stop_word.py` judges it with others.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.recognition.conformer import gelu

__all__ = ["StopWord", "shipped"]

Floats: TypeAlias = NDArray[np.float32]

WEIGHTS = Path(__file__).with_name("stop_word.npz")
BEFORE, AFTER, TAPS = 20, 8, 5
"""Frames that each opinion is of, before and after its own; frames of a convolution."""


class StopWord:
    """The network."""

    def __init__(self, weights: dict[str, Floats]) -> None:
        """`KeyError` for weights of another network."""
        self._first = weights["first"], weights["first_bias"]
        self._layers = [(weights[f"layer{n}"], weights[f"layer{n}_bias"], 2**n) for n in range(3)]
        self._last = weights["last"], float(weights["last_bias"][0])

    def ends(self, frames: Floats) -> Floats:
        """Log odds that STOP ends at each of the frames of 20 ms of `Conformer.frames`."""
        x = frames - frames.mean(axis=1, keepdims=True)
        x = x / np.sqrt(np.square(x).mean(axis=1, keepdims=True) + np.float32(1e-5))
        x = gelu(x @ self._first[0] + self._first[1])
        x = np.pad(x, ((BEFORE, AFTER), (0, 0)))
        for weight, bias, apart in self._layers:
            count = len(x) - (TAPS - 1) * apart
            taps = [x[tap * apart : tap * apart + count] for tap in range(TAPS)]
            x = gelu(np.concatenate(taps, axis=1) @ weight + bias)
        found: Floats = x @ self._last[0] + self._last[1]
        return found


@lru_cache(maxsize=1)
def shipped() -> StopWord:
    """The one that is trained."""
    with np.load(WEIGHTS) as packed:
        return StopWord({name: packed[name].astype(np.float32) for name in packed.files})
