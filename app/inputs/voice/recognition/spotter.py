"""STOP found in what is not yet said to its end, whatever is said before and after it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.endpoint import MIN_LEVEL, Segment
from app.inputs.voice.audio.noise import RATE, decibels
from app.inputs.voice.interfaces.speech_recognizer import Grammar
from app.inputs.voice.recognition.ctc import FRAME, Acoustics, Sequences, frames_of
from app.inputs.voice.recognition.lexicon import background, pronunciations
from app.inputs.voice.recognition.rechecks import levelled

__all__ = ["Spotted", "Spotter"]

STOP = "stop"
"""The word that is found in running sound."""
RUNNING_WINDOW = 1.6
"""Running sound is looked at so far back: as much as the word's network was trained on [s]."""
AROUND = 45, 12
"""Its sounds are looked for in so many frames before and after the one where it ends."""
EASED = 4.0
"""Its rivals may then explain the sounds better by so much more [log likelihood]: the network has spoken against them."""
RUNNING_PERIOD = 0.15
"""And so often, as long as there is any [s]."""
SOUND_TIME = 0.4
"""There is, where it was louder than nobody's voice within so long [s]."""
SURE, LIKELY = 4.0, 1.0
"""STOP is where the network is as sure as that by itself, or where it is as sure as this and its sounds are there too [log odds]."""
SEARCH_WINDOW = 1.0
"""What is looked at: the longest STOP that people say, with a little before [s]."""
SEARCH_DELAYS = (0.06, 0.14, 0.24)
"""Looked at again so long after the voice has sunk: at the closing of a `p`, and at its release [s]."""
SEARCH_PERIOD = 0.4
"""While the voice goes on without sinking it is looked at so often [s]."""
MIN_STOP_TIME = 0.24
"""Nobody says STOP faster [s]."""
MIN_FIT = -1.0
"""Log likelihood a sound, against the free decoding."""
OVER, OVER_END = 3.0, 2.0
"""Another command or a word that begins like STOP may explain the same sounds better by so much, and it is still STOP; one that
only ends like it, by less: nobody swallows the beginning [log likelihood]."""
NEAR, END = ("s t", "s p"), "ɑ p"
"""How the neighbours of STOP begin, or else end, that are compared, beside the other commands."""


@dataclass(frozen=True, slots=True)
class Spotted:
    """It was said."""

    command: str
    phrase: str
    fit: float
    """Log likelihood a sound; 0 is as good as the free decoding."""
    ended: float
    """When its last sound was heard [s]."""


class Spotter:
    """Asked with each bit of audio; runs the model only when a word may just have ended."""

    def __init__(self, grammar: Grammar, model: Acoustics) -> None:
        """Looks for the grammar's urgent intents."""
        self._model = model
        ways = [
            (command, phrase, sounds)
            for command in sorted(grammar.urgent)
            for phrase in grammar.phrases.get(command, ())
            for sounds in pronunciations(phrase)
        ]
        self._ways = ways
        self._command = next((command for command, phrase, _ in ways if phrase == STOP), "")
        self._ran, self._runs = math.nan, False
        mine = {sounds for _, _, sounds in ways}
        neighbours = {
            sounds for phrases in grammar.phrases.values() for p in phrases for sounds in pronunciations(p)
        }
        neighbours |= {sounds for _, sounds in background() if " ".join(sounds).startswith(NEAR)}
        ends = {sounds for _, sounds in background() if " ".join(sounds).endswith(END)} - neighbours
        rivals = [sounds for sounds in sorted(neighbours | ends) if sounds not in mine]
        self._over = np.array([OVER_END if sounds in ends else OVER for sounds in rivals])
        self._sequences = Sequences([*(sounds for _, _, sounds in ways), *rivals]) if ways else None
        self._looked = -math.inf
        self._begun = math.nan
        self._done: set[float] = set()

    def running(self, recent: NDArray[np.float32], now: float) -> Spotted | None:
        """STOP in the last `RUNNING_WINDOW`, heard until `now` [s], whatever sounds before, with and after it."""
        if not self._command or 0 <= now - self._ran < RUNNING_PERIOD - 1e-3:
            return None
        if decibels(recent[-int(SOUND_TIME * RATE) :]) < MIN_LEVEL:
            return None
        self._ran = now
        level = levelled(recent)
        ends = self._model.stop_ends(level)
        self._runs = ends is not None
        if ends is None:
            return None
        last = int(ends.argmax())
        if ends[last] < LIKELY or (ends[last] < SURE and not self._sounds(level, last)):
            return None
        fit = -math.log1p(math.exp(-float(ends[last])))
        return Spotted(self._command, STOP, fit, now - (len(ends) - 1 - last) * FRAME)

    def _sounds(self, samples: NDArray[np.float32], last: int) -> bool:
        """The sounds of STOP are about that frame."""
        frames = frames_of(self._model.log_probs(samples), self._model.tokens)
        return self._best(frames[max(0, last - AROUND[0]) : last + AROUND[1]], EASED) is not None

    def holds(self, samples: NDArray[np.float32]) -> bool:
        """The word may be in these; True where nobody has an opinion."""
        size, step = int(RUNNING_WINDOW * RATE), int(SOUND_TIME * RATE)
        for end in range(min(size, len(samples)), len(samples) + step, step):
            ends = self._model.stop_ends(levelled(samples[max(0, end - size) : end]))
            if ends is None or ends.max() >= LIKELY:
                return True
        return False

    def search(self, segment: Segment, now: float) -> Spotted | None:
        """The words so far, heard until `now` [s]; what was spotted in them, where nobody listens to `running` sound."""
        if self._runs or self._sequences is None or not self._due(segment, now):
            return None
        self._looked = now
        spotted = self.find(segment.samples[-int(SEARCH_WINDOW * RATE) :], now)
        return spotted and replace(spotted, ended=min(spotted.ended, segment.ended))

    def find(self, samples: NDArray[np.float32], now: float) -> Spotted | None:
        """The same in any samples, the last of which was heard at `now`."""
        if self._sequences is None or len(samples) < MIN_STOP_TIME * RATE:
            return None
        frames = frames_of(self._model.log_probs(samples), self._model.tokens)
        best = self._best(frames)
        if best is None:
            return None
        way, fit, last = best
        command, phrase, _ = self._ways[way]
        return Spotted(command, phrase, fit, now - (len(frames) - 1 - last) * FRAME)

    def _best(self, frames: NDArray[np.float64], eased: float = 0.0) -> tuple[int, float, int] | None:
        """Which of the ways to say it, how well it fits [log likelihood a sound] and with which frame it ends; None where none fits."""
        if self._sequences is None or not len(frames):
            return None
        fits, when = self._sequences.anywhere(frames)
        ours, rivals = fits[: len(self._ways)], fits[len(self._ways) :]
        lengths = np.array([len(sounds) for _, _, sounds in self._ways])
        best = int(np.argmax(ours / lengths))
        fit = float(ours[best] / lengths[best])
        if fit < MIN_FIT or (len(rivals) and ours[best] < (rivals - self._over).max() - eased):
            return None
        return best, fit, int(when[best])

    def _due(self, segment: Segment, now: float) -> bool:
        if segment.began != self._begun:
            self._begun, self._looked, self._done = segment.began, segment.began, set()
        quiet = now - segment.ended
        if quiet < SEARCH_DELAYS[0]:
            self._done = set()
            return now - self._looked >= SEARCH_PERIOD
        due = {look for look in SEARCH_DELAYS if quiet >= look} - self._done
        self._done |= due
        return bool(due)
