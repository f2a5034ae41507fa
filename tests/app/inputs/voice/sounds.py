"""A model that hears what a test writes, and sound to go with it."""

from __future__ import annotations

import numpy as np

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.recognition.lexicon import PHONES

TOKENS = [*dict.fromkeys(sign for signs in PHONES.values() for sign in signs), "<wb>", "<blank>"]


def opinion(ipa: str, *, sure: float = 0.9, frames_each: int = 3) -> np.ndarray:
    """Log probabilities of a model that is as sure as that of the sounds, with silence between them."""
    blank = TOKENS.index("<blank>")
    path = [blank] * 4
    for sound in ipa.split():
        path += [TOKENS.index(PHONES[sound][0])] * frames_each + [blank]
    path += [blank] * 4
    table = np.full((len(path), len(TOKENS)), (1 - sure) / (len(TOKENS) - 1))
    table[np.arange(len(path)), path] = sure
    return np.log(table)


class Written:
    """Hears the same sounds whatever the samples are, and counts how often it was asked."""

    tokens = TOKENS

    def __init__(self, ipa: str, sure: float = 0.9) -> None:
        self.table, self.asked = opinion(ipa, sure=sure), 0

    def log_probs(self, samples: np.ndarray) -> np.ndarray:
        self.asked += 1
        return self.table

    def stop_ends(self, samples: np.ndarray) -> np.ndarray | None:
        return None


def quiet(seconds: float, level: float = 1e-3) -> np.ndarray:
    """Faint noise."""
    rng = np.random.default_rng(3)
    return (level * rng.standard_normal(int(seconds * RATE))).astype(np.float32)


def voice(seconds: float, level: float = 0.3) -> np.ndarray:
    """Something as loud as a voice."""
    at = np.arange(int(seconds * RATE)) / RATE
    return (level * np.sin(2 * np.pi * 150 * at) * (0.7 + 0.3 * np.sin(2 * np.pi * 4 * at))).astype(
        np.float32
    )
