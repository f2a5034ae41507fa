"""Scores of commands by a neural phoneme recogniser's opinion of every 20 ms: the package `hama`, whose model is in its wheel.

The model says for each frame how probable each sound is. How well a command explains the frames is the CTC forward algorithm
(Graves, Fernández, Gomez, Schmidhuber 2006) over its sounds, for all commands and all background words at once. A
command is accepted if it explains the frames nearly as well as the best sounds without any grammar, and better than every
background word by what is asked of a command of its length: two sounds are soon found in anything.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.lexicon import PHONES, Sounds, background, pronunciations

__all__ = ["FRAME", "Acoustics", "Found", "Scorer", "Sequences", "frames_of"]

Array = NDArray[np.float64]

FRAME = 0.02
"""One line of the model's output covers so much [s]."""
EXPLAINS = -2.5
"""A command is rejected if it explains the sounds worse than this [log likelihood a sound, against the free decoding]."""
WINS, EASES = 0.5, 1.5
"""By so much more than any background word a command of two sounds must explain, and so much less for each further sound [log likelihood]."""
EASED = 8.5
"""No command is eased by more [log likelihood]."""
DOUBTS = 0.5
"""That ease is given in full where the background word itself explains the sounds as badly as that, in noise or a mumble; where it is
clear what was said, less [log likelihood a sound]."""
CLEAR, CLEAR_URGENT = 0.4, 0.8
"""So much of it is given however clear that is: to a command, and to STOP, whose end people swallow."""
POOR, WEIGHS = -0.8, 0.5
"""What a command explains worse than this [log likelihood a sound] is held against it, so much of it; not against STOP."""
URGENT = 2.0
"""STOP may explain so much less than that [log likelihood]: a false one costs little, one not heard may cost everything."""
PREFERRED = 1.0
"""Where STOP and another command are nearly alike, STOP is meant [log likelihood a sound]."""
STEEP = 2.0
"""How confidence grows with what is left over [log likelihood]."""
FLOOR = 1e-12
"""No sound is less probable in any frame."""


class Acoustics(Protocol):
    """A model that hears sounds."""

    tokens: Sequence[str]
    """Its signs, the last two of which mean a new word and nothing new."""

    def log_probs(self, samples: NDArray[np.float32]) -> Array:
        """Log probability of each sign in each frame: frames x signs. Samples at 16 kHz, -1 to 1."""
        ...

    def stop_ends(self, samples: NDArray[np.float32]) -> NDArray[np.float32] | None:
        """Log odds that the word STOP ends at each frame; None where it has no opinion."""
        ...


def frames_of(log_probs: Array, tokens: Sequence[str]) -> Array:
    """Probability of silence and of each of `PHONES` in each frame, over that of the frame's likeliest sign."""
    index = {token: number for number, token in enumerate(tokens)}
    relative = np.exp(log_probs - log_probs.max(axis=1, keepdims=True))
    columns = [relative[:, [index["<blank>"], index["<wb>"]]].sum(axis=1)]
    columns += [
        relative[:, [index[sign] for sign in signs if sign in index]].sum(axis=1) for signs in PHONES.values()
    ]
    frames: Array = np.maximum(np.stack(columns, axis=1), FLOOR)
    return frames


class Sequences:
    """Words as sounds, laid out so that all of them are scored at once."""

    def __init__(self, words: Sequence[Sounds]) -> None:
        """At least one word, of at least one sound each."""
        numbers = {phone: number + 1 for number, phone in enumerate(PHONES)}
        states = 2 * max(map(len, words)) + 1
        self._labels = np.zeros((len(words), states), np.intp)
        for row, word in enumerate(words):
            self._labels[row, 1 : 2 * len(word) + 1 : 2] = [numbers[sound] for sound in word]
        self._skips = np.zeros((len(words), states))
        self._skips[:, 3::2] = self._labels[:, 3::2] != self._labels[:, 1:-2:2]
        self._rows = np.arange(len(words))
        self._ends = np.array([2 * len(word) for word in words])

    def whole(self, frames: Array) -> Array:
        """How well each word explains all the frames [log likelihood, against the likeliest sign of each frame]."""
        alpha, scale = self._begin(frames[0]), np.zeros(len(self._rows))
        for number in range(1, len(frames)):
            alpha = self._step(alpha, frames[number])
            if number % 8 == 0:
                most = np.maximum(alpha.max(axis=1), 1e-280)
                alpha /= most[:, None]
                scale += np.log(most)
        return np.log(np.maximum(self._ended(alpha), 1e-300)) + scale

    def anywhere(self, frames: Array) -> tuple[Array, NDArray[np.intp]]:
        """The same for a word that may begin and end at any frame amid others; and with which frame it ended."""
        alpha = self._begin(frames[0])
        best, when = np.zeros(len(self._rows)), np.zeros(len(self._rows), np.intp)
        for number in range(1, len(frames)):
            alpha = self._step(alpha, frames[number])
            alpha[:, 0] = 1.0
            ended = self._ended(alpha)
            when[ended > best] = number
            best = np.maximum(best, ended)
        return np.log(np.maximum(best, 1e-300)), when

    def _begin(self, frame: Array) -> Array:
        alpha = np.zeros(self._labels.shape)
        alpha[:, :2] = frame[self._labels[:, :2]]
        return alpha

    def _step(self, alpha: Array, frame: Array) -> Array:
        further = alpha.copy()
        further[:, 1:] += alpha[:, :-1]
        further[:, 2:] += alpha[:, :-2] * self._skips[:, 2:]
        further *= frame[self._labels]
        return further

    def _ended(self, alpha: Array) -> Array:
        found: Array = alpha[self._rows, self._ends] + alpha[self._rows, self._ends - 1]
        return found


@dataclass(frozen=True, slots=True)
class Found:
    """What was most likely said."""

    command: str
    phrase: str
    confidence: float
    """0 to 1; accepted from 0.5 on."""
    alternatives: tuple[tuple[str, float], ...]
    """Other commands with their confidence, best first."""
    explains: float
    """Log likelihood a sound, against the free decoding; 0 is as good."""
    rival: str
    """The background word that explains it best."""

    @property
    def accepted(self) -> bool:
        """It is a command."""
        return self.confidence >= 0.5


class Scorer:
    """Judges the frames of one utterance by a grammar."""

    def __init__(self, grammar: Grammar, tokens: Sequence[str]) -> None:
        """`VoiceTrouble` for a phrase whose sounds are not known."""
        ways = [
            (command, phrase, sounds)
            for command, phrases in grammar.phrases.items()
            for phrase in phrases
            for sounds in pronunciations(phrase)
        ]
        ours = {sounds for _, _, sounds in ways}
        self._tokens = tokens
        self._commands = [command for command, _, _ in ways]
        self._phrases = [phrase for _, phrase, _ in ways]
        self._lengths = np.array([len(sounds) - 2 * ("͡" in sounds) for _, _, sounds in ways])
        self._urgent = np.array([command in grammar.urgent for command in self._commands])
        self._others = [(word, sounds) for word, sounds in background() if sounds not in ours]
        self._sequences = Sequences([*(way[2] for way in ways), *(sounds for _, sounds in self._others)])
        self._eased = np.minimum(EASES * (self._lengths - 2), EASED)
        self._least = np.where(self._urgent, CLEAR_URGENT, CLEAR)

    def judge(self, views: Sequence[Array], heeded: Collection[str]) -> Found | None:
        """The command of `heeded` that was most likely said; None where nothing was heard or nothing is heeded.

        `views` are the model's opinions of the same words, which are taken together: [0] alone, or several."""
        counts = np.array([command in heeded for command in self._commands])
        if min(map(len, views)) < 4 or not counts.any():
            return None
        frames = [frames_of(view, self._tokens) for view in views]
        likely: Array = np.mean([self._sequences.whole(each) for each in frames], axis=0)
        ours, others = likely[: len(counts)], likely[len(counts) :]
        explains = ours / self._lengths
        rival = int(others.argmax())
        left = self._left(ours, float(others[rival]), len(self._others[rival][1]))
        order = np.argsort(-np.where(counts, explains + PREFERRED * self._urgent, -np.inf))
        best = int(order[0])
        sure: dict[str, float] = {}
        for place in order[: int(counts.sum())]:
            sure.setdefault(self._commands[place], _confidence(float(left[place])))
        command = self._commands[best]
        confidence = sure.pop(command)
        return Found(
            command,
            self._phrases[best],
            confidence,
            tuple(list(sure.items())[:3]),
            float(explains[best]),
            self._others[rival][0],
        )

    def _left(self, ours: Array, rival: float, sounds: int) -> Array:
        """By how much each command does better than is asked of it, against a background word of so many sounds [log likelihood]."""
        explains = ours / self._lengths
        ease = np.clip(-rival / sounds / DOUBTS, self._least, 1.0) * self._eased
        poor = WEIGHS * np.minimum(0.0, explains - POOR) * ~self._urgent
        left: Array = np.minimum(
            ours - rival - WINS + ease + URGENT * self._urgent + poor, (explains - EXPLAINS) * 4.0
        )
        return left


def _confidence(left: float) -> float:
    """0.5 where just as much is there as is asked."""
    return 1.0 / (1.0 + math.exp(-max(-60.0, min(60.0, left / STEEP))))
