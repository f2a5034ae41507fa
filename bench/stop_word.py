"""The word STOP in running sound: heard at every moment, and not heard where nobody says it.

Everything goes through the app's own way in, in pieces of 50 ms as from a microphone: noise meter, end points, network for the word, scorer,
and the grammar of the driving screen. The network was trained on other synthetic voices than those that are judged here: espeak-ng's
`adam`, `michael`, `belinda`, `benjamin`, `travis`, `victor`, `anika` and `quincy`, flite's `rms` where that is installed, and with
`--data DIR` the people in `DIR/speech_commands/stop` (a file for each recording, its name up to the first `_` the person). Each
says STOP after 6 s of talk, 5 s into a motor that starts, and alone; it counts where it is heard from 0.4 s before to 0.3 s after its end.

False STOPs are counted in all files of `DIR/talk` (running speech, radio, wind, music, that do not say the word), each as it is.
Intervals are Wilson's of 95 %, for a rate an hour Byar's.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import Samples, chunks, read
from app.inputs.voice.interfaces.speech_recognizer import Event, Grammar, Result
from app.inputs.voice.recognition.hearing import Judge, Phonemes, SpeechPipeline
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.model import HamaModel
from bench.support.figures import Figure
from bench.support.harness import Context, Sides
from bench.support.voices import espeak, flite, noise

REPEATS = 1
VOICES = (
    "en-us+adam", "en-gb+michael", "en-gb-scotland+belinda", "en-us+benjamin",
    "en-gb-x-rp+travis", "en-gb-x-gbclan+victor", "en-029+anika", "en-us+quincy",
)  # fmt: skip
TALK = (
    "The door of the kitchen was open when we came back from the garden.", "Nobody knows how many boxes are still in the hall.",
    "We could go over there and look at the other room first.", "She said that the meeting begins at half past nine.",
    "It was a long way and the weather was not very good.",
)  # fmt: skip
EARLY, LATE = 0.4, 0.3
"""STOP is heard in time from so long before its end to so long after it [s]."""
SCENES: dict[str, float] = {"talk": math.inf, "motor_10": 10.0, "motor_3": 3.0, "alone": math.inf}
"""Ratio of the word to the noise [dB]."""
HEARD = {"talk": 0.9, "motor_10": 0.9, "motor_3": 0.7, "alone": 0.95}


def _figures() -> Iterator[Figure]:
    said = {
        "talk": "after 6 s of talk",
        "motor_10": "5 s into a motor, 10 dB",
        "motor_3": "5 s into a motor, 3 dB",
        "alone": "alone",
    }
    for scene, what in said.items():
        yield Figure(f"heard_{scene}", "", f"STOP {what}: heard in time, all voices", HEARD[scene], "more")
        yield Figure(f"low_{scene}", "", f"STOP {what}: lower end of the interval", better="more")
        yield Figure(f"worst_{scene}", "", f"STOP {what}: worst voice", better="more")
        yield Figure(
            f"people_{scene}", "", f"STOP {what}: people (--data)", HEARD[scene], "more", needs_data=True
        )
    yield Figure("voices", "", "voices and people that said it", better="more")
    yield Figure("false", "/h", "false STOP in running sound (--data)", 2.0, needs_data=True)
    yield Figure("false_high", "/h", "false STOP in running sound: upper end of the interval (--data)")
    yield Figure("hours", "h", "of running sound (--data)", better="more")
    yield Figure("cost", "of real time", "hands-free in running sound, on one core", 0.1)


FIGURES = tuple(_figures())


@dataclass(frozen=True, slots=True)
class Said:
    """One recording of the word."""

    who: str
    person: bool
    samples: Samples


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """The voices speak once."""
    judge = Phonemes(Grammar(COMMANDS), HamaModel())
    stops = [
        Said(VOICES[place], False, samples) for place, (_, samples) in enumerate(espeak(["stop"], VOICES))
    ]
    stops += [Said("rms", False, samples) for _, samples in flite(["stop", "Stop!"], ("rms",))]
    if context.data:
        paths = sorted((context.data / "speech_commands" / "stop").glob("*.*"))
        stops += [Said(path.name.split("_")[0], True, _loud(read(path))) for path in paths for _ in range(3)]
    talk = np.concatenate([samples for _, samples in espeak(TALK, VOICES[:3])])
    files = sorted((context.data / "talk").glob("*.*")) if context.data else []
    yield Sides(lambda: {**heard(judge, stops, talk), **false(judge, files)}, None)


def heard(judge: Judge, stops: Sequence[Said], talk: Samples) -> dict[str, float]:
    """Of each scene."""
    figures: dict[str, float] = {"voices": float(len({said.who for said in stops}))}
    for scene, ratio in SCENES.items():
        rng = np.random.default_rng(5)
        told = [(said, _in_time(judge, scene, ratio, said.samples, talk, rng)) for said in stops]
        figures[f"heard_{scene}"] = float(np.mean([right for _, right in told]))
        figures[f"low_{scene}"] = wilson(sum(right for _, right in told), len(told))
        who = {said.who for said in stops}
        figures[f"worst_{scene}"] = min(
            float(np.mean([right for said, right in told if said.who == one])) for one in who
        )
        people = [right for said, right in told if said.person]
        if people:
            figures[f"people_{scene}"] = float(np.mean(people))
    return figures


def _in_time(
    judge: Judge, scene: str, ratio: float, word: Samples, talk: Samples, rng: np.random.Generator
) -> bool:
    power = float(np.sqrt(np.mean(np.square(word[np.abs(word) > 0.02 * np.abs(word).max()]))))
    before = int((6.0 if scene == "talk" else 5.0) * RATE) + int(rng.integers(RATE // 10))
    start = int(rng.integers(max(1, len(talk) - before)))
    lead = talk[start : start + before] if scene == "talk" else np.zeros(before, np.float32)
    sound = np.concatenate((np.zeros(RATE, np.float32), lead, word, np.zeros(RATE, np.float32)))
    if math.isfinite(ratio):
        sound[RATE:] += noise("motor", len(sound) - RATE, rng) * power * 10 ** (-ratio / 20)
    loud = np.flatnonzero(np.abs(word) > np.abs(word).max() / 30)
    end = (RATE + before + int(loud[-1])) / RATE
    return any(end - EARLY <= at <= end + LATE + 0.05 for at in stops_in(judge, sound))


def stops_in(judge: Judge, sound: Samples) -> list[float]:
    """When STOP was told [s]."""
    told: list[Event] = []
    pipeline, found = SpeechPipeline(Grammar(COMMANDS), judge, told.append), []
    faint = (3e-4 * np.random.default_rng(6).standard_normal(len(sound))).astype(np.float32)
    for part, at in chunks(sound + faint):
        told.clear()
        pipeline.feed(part, at)
        if any(isinstance(event, Result) and event.command == "stop" for event in told):
            found.append(at)
    return found


def false(judge: Judge, files: Sequence[Path]) -> dict[str, float]:
    """In sound without the word; STOPs within 2 s are one."""
    count, seconds, began = 0, 0.0, time.process_time()
    for path in files:
        sound = read(path)
        found = stops_in(judge, sound)
        apart = [at for place, at in enumerate(found) if not place or at - found[place - 1] > 2.0]
        count, seconds = count + len(apart), seconds + len(sound) / RATE
        print(f"  {path.name}: {len(apart)} in {len(sound) / RATE / 60:.1f} min")
    if not files:
        return {}
    cost = (time.process_time() - began) / seconds
    hours = seconds / 3600
    high = (count + 1) * (1 - 1 / (9 * (count + 1)) + 1.96 / (3 * math.sqrt(count + 1))) ** 3
    return {"false": count / hours, "false_high": high / hours, "hours": hours, "cost": cost}


def wilson(right: int, of: int) -> float:
    """The lower end of the interval of 95 % for a share."""
    z, share = 1.96, right / of
    middle = share + z * z / (2 * of)
    return (middle - z * math.sqrt(share * (1 - share) / of + z * z / (4 * of * of))) / (1 + z * z / of)


def _loud(samples: Samples) -> Samples:
    """As loud as the synthetic voices."""
    level: Samples = (0.4 * samples / max(1e-6, float(np.abs(samples).max()))).astype(np.float32)
    return level
