"""The model that hears sounds: the weights of the package `hama`, run by `app.inputs.voice.recognition.conformer` or else by the package's own engine."""

from __future__ import annotations

import ctypes
import importlib
import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.interfaces.speech_recognizer import VoiceTrouble
from app.inputs.voice.recognition.conformer import Conformer, unpacked
from app.inputs.voice.recognition.stop_word import shipped
from widgets.core.language import tr

__all__ = ["HamaModel", "chosen", "one_core"]

log = logging.getLogger(__name__)

Floats: TypeAlias = NDArray[np.float32]
Way: TypeAlias = Callable[[Floats], Floats]

WEIGHTS = "asr_waveform.hama"
MIN_SAMPLES = 400
"""Less is filled up with silence: one window of the spectrum [samples]."""
MAX_DIFFERENCE = 0.01
"""Two ways that differ by less compute the same [probability]."""
THREADS = "scipy_openblas_set_num_threads64_", "scipy_openblas_set_num_threads", "openblas_set_num_threads"
"""How numpy's library calls what sets its number of threads."""


class HamaModel:
    """The model in the package `hama`."""

    def __init__(self) -> None:
        """`VoiceTrouble` where the package is missing, or can be run in no way."""
        try:
            from hama.vocab import Vocabulary

            self.tokens: Sequence[str] = [*Vocabulary.load(None).decoder, "<wb>", "<blank>"]
        except (
            ImportError,
            RuntimeError,
            OSError,
            LookupError,
            ValueError,
            TypeError,
            AttributeError,
        ) as problem:
            raise VoiceTrouble(
                tr("The phoneme recogniser cannot be loaded: {problem}.").format(problem=problem)
            ) from problem
        one_core()
        self._hear = chosen(_ours, _engine, len(self.tokens))

    def log_probs(self, samples: Floats) -> NDArray[np.float64]:
        """Log probability of each sign in each frame of 20 ms."""
        return self._hear(_wave(samples)).astype(np.float64)

    def stop_ends(self, samples: Floats) -> Floats | None:
        """Log odds that the word STOP ends at each frame of 20 ms; None where the package's own engine runs the network, which does not show
        what it hears."""
        if not isinstance(self._hear, Conformer):
            return None
        return shipped().ends(self._hear.frames(_wave(samples)))


def _wave(samples: Floats) -> Floats:
    wave = np.clip(samples, -1.0, 1.0).astype(np.float32)
    return wave if len(wave) >= MIN_SAMPLES else np.pad(wave, (0, MIN_SAMPLES - len(wave)))


def chosen(ours: Callable[[], Way], theirs: Callable[[], Way], signs: int) -> Way:
    """The cheaper of two ways that say the same of so many signs; theirs where they do not, or where ours fails, which the log tells
    in one line; ours where they have none.

    `VoiceTrouble` where neither can be had."""
    wave = (0.1 * np.random.default_rng(0).standard_normal(4000)).astype(np.float32)
    mine, why = _tried(ours, wave, signs)
    engine, worse = _tried(theirs, wave, signs)
    if engine is None:
        if mine is None:
            raise VoiceTrouble(
                tr("The phoneme recogniser cannot be loaded: {worse}.").format(worse=worse)
            ) from worse
        return mine.way
    if mine is not None and _alike(mine.said, engine.said):
        return mine.way if mine.cost < engine.cost else engine.way
    log.warning("The model is run by the engine of its package: %s", why or "by numpy it says something else")
    return engine.way


def one_core() -> None:
    """Have numpy multiply in one thread: matrices as small as these only keep a second core waiting. Where it cannot be told, nothing."""
    try:
        core = importlib.import_module("numpy._core._multiarray_umath")
        library = ctypes.CDLL(core.__file__)
    except (ImportError, OSError, TypeError):
        return
    for name in THREADS:
        if hasattr(library, name):
            getattr(library, name)(ctypes.c_int(1))
            return


@dataclass(frozen=True, slots=True)
class _Tried:
    way: Way
    said: Floats
    cost: float
    """When it is not the first time [s of this thread]."""


def _tried(make: Callable[[], Way], wave: Floats, signs: int) -> tuple[_Tried | None, Exception | None]:
    """The way and what it says; or why it does not work."""
    try:
        way, costs = make(), []
        for _ in range(2):
            began = time.thread_time()
            said = way(wave)
            costs.append(time.thread_time() - began)
        if said.ndim != 2 or said.shape[1] != signs or not np.isfinite(said).all():
            raise ValueError(
                tr("it does not give a probability of each of {signs} signs").format(signs=signs)
            )
    except Exception as problem:  # noqa: BLE001 - foreign weights, a foreign library: there may be the other way
        return None, problem
    return _Tried(way, said, min(costs)), None


def _alike(said: Floats, truth: Floats) -> bool:
    return said.shape == truth.shape and bool(np.abs(np.exp(said) - np.exp(truth)).max() < MAX_DIFFERENCE)


def _ours() -> Way:
    from importlib import resources

    return Conformer(unpacked(resources.files("hama.assets").joinpath(WEIGHTS).read_bytes()))


def _engine() -> Way:
    from hama import ASRModel

    session: Any = ASRModel().session

    def hear(wave: Floats) -> Floats:
        length = np.array([len(wave)], np.int64)
        found = session.run(["log_probs"], {"waveform": wave.reshape(1, -1), "waveform_lengths": length})
        return np.asarray(found[0][0], np.float32)

    return hear
