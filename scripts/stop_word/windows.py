"""What the network learns from: windows of sound with and without the word, as the phoneme model hears them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.recognition.conformer import Conformer
from app.inputs.voice.recognition.ctc import Sequences, frames_of
from app.inputs.voice.recognition.rechecks import levelled
from app.inputs.voice.recognition.spotter import RUNNING_WINDOW
from scripts.stop_word.disturbances import NOISES, Samples, level_of, noise, resized, through_a_room
from scripts.stop_word.voices import Said

__all__ = ["Drawer", "Voice", "voice_of"]

SIZE = int(RUNNING_WINDOW * RATE)
SOUNDS = ("s", "t", "ɑ", "p")
"""Of the word, as the phoneme model spells it."""
CLEAR = -2.0
"""A sentence counts only where the sounds fit as well as that: else nobody knows where the word ends [log likelihood a sound]."""
SIZES = 0.82, 1.22
"""Of speakers."""
RECENT = 0.35, 0.85
"""Since the word ended, three times of four up to the first, else up to the second [s]."""
SHARES = {
    "motor": 0.28,
    "pink": 0.10,
    "white": 0.06,
    "brown": 0.06,
    "wind": 0.14,
    "music": 0.18,
    "babble": 0.18,
}
"""How often a disturbance is what."""
EASY_KEPT = 0.5
"""Part of the windows that are kept although the network is sure already that nobody says it."""
HARD = -3.0
"""Where it is less sure than this [log odds]."""


class Voice(NamedTuple):
    """One voice, sorted by what it says."""

    prose: list[Samples]
    near: list[Samples]
    alone: list[Samples]
    amid: list[tuple[Samples, int]]
    """And where the word ends in it [samples]."""


def voice_of(said: Sequence[Said], model: Conformer, tokens: Sequence[str]) -> Voice:
    """The phrases of a voice, those with the word among others where it can be told where it ends."""
    voice, word = Voice([], [], [], []), Sequences([SOUNDS])
    for kind, sound in said:
        if kind != "amid":
            getattr(voice, kind).append(sound)
            continue
        frames = frames_of(model(levelled(sound.astype(np.float32))).astype(np.float64), tokens)
        fits, when = word.anywhere(frames)
        if fits[0] / len(SOUNDS) > CLEAR:
            voice.amid.append((sound, int((when[0] + 1) * RATE / 50)))
    return voice


class Drawer:
    """Draws windows."""

    def __init__(
        self, voices: Mapping[str, Voice], weights: Mapping[str, float], seed: Sequence[int]
    ) -> None:
        """Each voice speaks as often as its weight says [1]."""
        self._rng, self._voices = np.random.default_rng(seed), list(voices.values())
        shares = np.array([weights[name] for name in voices])
        self._shares = shares / shares.sum()

    def windows(
        self, count: int, said: float, model: Conformer, known: Callable[[NDArray[np.float32]], float]
    ) -> tuple[NDArray[np.float16], NDArray[np.bool_]]:
        """`count` windows, a part `said` with the word: what the model hears, count x frames x 144, and whether the word ends in each.

        Of those without, fewer where `known`, the log odds of a network that is there already, says so anyway.
        """
        heard: list[NDArray[np.float16]] = []
        truth: list[bool] = []
        while len(heard) < count:
            says = bool(self._rng.random() < said)
            sound = self._with() if says else self._without()
            frames = model.frames(levelled(sound))
            if says or self._rng.random() < EASY_KEPT or known(frames) > HARD:
                heard.append(frames.astype(np.float16))
                truth.append(says)
        return np.stack(heard), np.array(truth)

    def _voice(self) -> Voice:
        return self._voices[int(self._rng.choice(len(self._voices), p=self._shares))]

    def talk(self, count: int, voice: Voice | None = None, near: float = 0.15) -> Samples:
        """`count` samples of what somebody says, never the word; a part `near` of it sounds like it."""
        voice, rng, parts, size = voice or self._voice(), self._rng, [], 0
        while size < count + RATE // 2:
            pool = voice.near if rng.random() < near else voice.prose
            sound = pool[int(rng.integers(len(pool)))] * rng.uniform(0.5, 1.2)
            parts += [sound, np.zeros(int(rng.uniform(0.02, 0.5) * RATE))]
            size += len(parts[-1]) + len(sound)
        first = int(rng.integers(size - count + 1))
        return np.concatenate(parts)[first : first + count]

    def babble(self, count: int) -> Samples:
        """Two to seven who talk at once."""
        together = np.zeros(count)
        for _ in range(self._rng.integers(2, 8)):
            together += self._resized(count, 0.3) * 10 ** (self._rng.uniform(-9, 0) / 20)
        return together

    def _resized(self, count: int, near: float) -> Samples:
        return resized(self.talk(int(1.3 * count), near=near), self._rng.uniform(*SIZES))[:count]

    def _without(self) -> NDArray[np.float32]:
        rng, share = self._rng, self._rng.random()
        if share < 0.05:
            kind = ("motor", "wind", "music", "pink")[int(rng.integers(4))]
            return self._disturbed(noise(kind, SIZE, rng), 1.0)
        if share < 0.45:
            sound = self.babble(SIZE)
        else:
            sound = self._resized(SIZE, 0.4)
            if rng.random() < 0.2:
                sound = sound + rng.uniform(0.2, 1.0) * self.talk(SIZE)
        return self._disturbed(sound, max(1e-3, level_of(sound)))

    def _with(self) -> NDArray[np.float32]:
        """The word ends in the window, with talk before it, after it, or none."""
        rng, voice = self._rng, self._voice()
        size = rng.uniform(*SIZES)
        if voice.amid and rng.random() < 0.45:
            sound, end = voice.amid[int(rng.integers(len(voice.amid)))]
            sound, end = resized(sound, size), int(end / size)
            level = level_of(sound)
        else:
            sound = resized(voice.alone[int(rng.integers(len(voice.alone)))], size)
            end, level = len(sound), level_of(sound)
            if rng.random() < 0.5:
                before = np.concatenate(
                    (self._beside(voice, level), np.zeros(int(RATE * rng.uniform(0, 0.3))))
                )
                sound, end = np.concatenate((before, sound)), end + len(before)
        if rng.random() < 0.4:
            sound = np.concatenate(
                (sound, np.zeros(int(RATE * rng.uniform(0.03, 0.3))), self._beside(voice, level))
            )
        ago = rng.uniform(0, RECENT[0]) if rng.random() < 0.75 else rng.uniform(*RECENT)
        return self._disturbed(_placed(sound, end, SIZE - int(RATE * ago)), level)

    def _beside(self, voice: Voice, level: float) -> Samples:
        """What is said before or after it, by the same voice or another, about as loud."""
        talk = self.talk(SIZE, voice if self._rng.random() < 0.6 else None)
        return talk * level / max(1e-4, level_of(talk)) * 10 ** (self._rng.uniform(-8, 4) / 20)

    def _disturbed(self, sound: Samples, level: float) -> NDArray[np.float32]:
        """In three of four windows with a noise 0 to 25 dB below the `level`, others' talk 6 to 28; always with a microphone's hiss."""
        rng = self._rng
        heard = through_a_room(sound, rng)
        if rng.random() < 0.75:
            kind = str(rng.choice(list(SHARES), p=list(SHARES.values())))
            below = rng.uniform(6, 28) if kind == "babble" else rng.uniform(0, 25)
            added = noise(kind, len(heard), rng) if kind in NOISES else self.babble(len(heard))
            heard = heard + added * (
                1.0 if kind in NOISES else 1 / max(1e-6, level_of(added))
            ) * level * 10 ** (-below / 20)
        heard = heard + level * 10 ** (rng.uniform(-60, -25) / 20) * rng.standard_normal(len(heard))
        if rng.random() < 0.05:
            heard = np.clip(heard, -2 * level, 2 * level)
        return heard.astype(np.float32)


def _placed(sound: Samples, end: int, at: int) -> Samples:
    """A window in which the sample `end` of a sound is at the place `at`."""
    window = np.zeros(SIZE)
    first, skipped = max(0, at - end), max(0, end - at)
    count = min(SIZE - first, len(sound) - skipped)
    window[first : first + count] = sound[skipped : skipped + count]
    return window
