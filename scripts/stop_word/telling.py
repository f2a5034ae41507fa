"""How well a network hears the word from voices that it has not learnt from, and how often it takes them for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.recognition.conformer import Conformer
from app.inputs.voice.recognition.rechecks import levelled
from app.inputs.voice.recognition.spotter import RUNNING_PERIOD
from scripts.stop_word.disturbances import Samples, level_of, noise
from scripts.stop_word.windows import SIZE, Drawer, Voice

__all__ = ["tell"]

Odds = Callable[[NDArray[np.float32]], float]

SURE = np.arange(-1.0, 6.1, 0.5)
"""Log odds that are tried."""
SECONDS = 480
"""Of talk of each kind."""
SPOKEN = ("talk", "babble", "motor", "music")
BELOW = 10.0
"""A noise is so much below a voice [dB]."""
SCENES = {
    "alone": None,
    "in a motor, 10 dB": ("motor", 10.0),
    "in a motor, 3 dB": ("motor", 3.0),
    "in music, 10 dB": ("music", 10.0),
}
STEP = int(RUNNING_PERIOD * RATE)
APART = 2.0
"""What is told within so long is told once [s]."""
HISS = 1e-3


def tell(voices: Mapping[str, Voice], model: Conformer, odds: Odds) -> Iterator[str]:
    """A line for each scene: the share of words that are heard, or false ones an hour, from each of `SURE` on."""
    rng, drawer = np.random.default_rng(99), Drawer(voices, dict.fromkeys(voices, 1.0), (99,))
    yield _line("sure from", SURE)
    for scene, disturbance in SCENES.items():
        best = [
            max(_looks(_said(sound, disturbance, rng), model, odds))
            for voice in voices.values()
            for sound in voice.alone
        ]
        yield _line(f"heard {scene}", [float(np.mean(np.array(best) > sure)) for sure in SURE])
    for kind in SPOKEN:
        found = np.array(_looks(_stream(drawer, kind, rng), model, odds))
        yield _line(
            f"false an hour in {kind}",
            [_times(found > sure) / (len(found) * RUNNING_PERIOD / 3600) for sure in SURE],
        )


def _line(what: str, figures: NDArray[np.float64] | list[float]) -> str:
    return f"{what:32}" + "".join(f"{figure:7.2f}" for figure in figures)


def _said(
    sound: Samples, disturbance: tuple[str, float] | None, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Two seconds, the word, and as long as it may take to be heard."""
    heard = np.concatenate((np.zeros(2 * RATE), sound, np.zeros(int(0.3 * RATE))))
    if disturbance is not None:
        kind, below = disturbance
        heard = heard + noise(kind, len(heard), rng) * level_of(sound) * 10 ** (-below / 20)
    return (heard + HISS * rng.standard_normal(len(heard))).astype(np.float32)


def _stream(drawer: Drawer, kind: str, rng: np.random.Generator) -> NDArray[np.float32]:
    count = SECONDS * RATE
    sound = drawer.babble(count) if kind == "babble" else drawer.talk(count)
    if kind not in ("babble", "talk"):
        sound = sound + noise(kind, count, rng) * level_of(sound) * 10 ** (-BELOW / 20)
    return (sound + HISS * rng.standard_normal(count)).astype(np.float32)


def _looks(sound: NDArray[np.float32], model: Conformer, odds: Odds) -> list[float]:
    """The log odds at each look, as the app looks."""
    return [
        odds(model.frames(levelled(sound[end - SIZE : end]))) for end in range(SIZE, len(sound) + 1, STEP)
    ]


def _times(found: NDArray[np.bool_]) -> int:
    """So often it would be told."""
    at = np.flatnonzero(found)
    return int((np.diff(at, prepend=-len(found)) * RUNNING_PERIOD > APART).sum())
