"""Offline recognition of spoken commands: recall, false commands, noise, latency of STOP, and cost.

Natural voices are synthesised by `hibari` (and by flite and piper where they are installed) at three speeds and three sizes of
the speaker, formant voices by `espeak-ng`; each says every phrase of the grammar, and phrases that are none. Noise is made by numpy: pink, wind
(below 300 Hz, in gusts) and a motor (95 Hz with 25 harmonics and hiss), 10 dB below the voice. With `--data DIR`, a folder for each
word with recordings in it, real people are judged with `stop`, `go`, `yes` and `no` in the grammar and all the other words outside it.

STOP and the cost are taken from one long stream, in pieces of 50 ms as from a microphone; the end of a word is where its
loudness falls below a thirtieth of its peak. The peer is pocketsphinx with a grammar of the same phrases on the same recordings.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import Samples, chunks, read
from app.inputs.voice.interfaces.speech_recognizer import Event, Grammar, Rejected, Result, VoiceTrouble
from app.inputs.voice.recognition.hearing import Judge, Phonemes, SpeechPipeline
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.model import HamaModel
from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.voices import NOISES, espeak, natural, noisy

PEER = "pocketsphinx, same phrases"
REPEATS = 1
SNR = 10.0
"""[dB]"""
REAL: dict[str, tuple[str, ...]] = {word: (word,) for word in ("stop", "go", "yes", "no")}
SPOKEN = {phrase: command for command, phrases in COMMANDS.items() for phrase in phrases}
OUTSIDE = (
    "what time is it", "the weather is nice today", "he stepped off the bus", "petrol station", "shop", "where is the robot",
    "I think so", "homework", "yesterday we went out", "could we hold a meeting", "castle", "left", "right", "house", "bird",
    "happy", "seven", "tree", "look at that", "the camera broke", "it is raining again", "who said that", "coffee please",
    "open the window", "my name is Marvin", "never mind", "thank you", "the battery is empty", "turn the page", "window",
)  # fmt: skip
"""Phrases of people who give no command; some resemble one."""
NEIGHBOURS = ("paws", "know", "stomp", "stab", "star", "guess", "gnome", "though", "past her", "top")
"""Words that are at most one sound away from a command: reported, without a target."""
AMID = (
    "on top of it", "step over here", "shop over there", "that is on top", "stay there", "stomp on it", "the next stage",
    "he is at the top", "stuff it in", "spot on",
)  # fmt: skip
"""In each is something that is nearly STOP."""
DRAWS = 3
"""Real people are few: each says its word in so many pieces of noise."""


def _figures() -> Iterator[Figure]:
    more: Literal["more"] = "more"
    yield Figure("natural", "", "natural voices: right commands accepted", 0.93, more, PEER)
    yield Figure("natural_wrong", "", "natural voices: taken for another command", against=PEER)
    yield Figure("outside", "", "phrases outside the grammar accepted", 0.01, against=PEER)
    yield Figure("neighbours", "", "a sound away from a command, or none, accepted", against=PEER)
    yield Figure("formant", "", "espeak-ng's voices: right commands accepted", better=more, against=PEER)
    for noise in NOISES:
        yield Figure(f"{noise}_10", "", f"natural voices in {noise} noise at 10 dB", 0.8, more, PEER)
        yield Figure(
            f"{noise}_10_outside",
            "",
            f"phrases outside the grammar accepted in {noise} at 10 dB",
            against=PEER,
        )
    yield from _real_people()
    yield from _stop_and_cost()


def _real_people() -> Iterator[Figure]:
    more: Literal["more"] = "more"
    yield Figure("real", "", "real people: right words accepted (--data)", 0.95, more, PEER, needs_data=True)
    yield Figure("real_stop", "", "real people: `stop` accepted (--data)", 1.0, more, PEER, needs_data=True)
    yield Figure(
        "real_outside", "", "real people: other words accepted (--data)", 0.01, against=PEER, needs_data=True
    )
    yield Figure(
        "real_streamed", "", "real people, by end points from a stream (--data)", better=more, against=PEER
    )
    for noise in NOISES:
        yield Figure(
            f"real_{noise}_10",
            "",
            f"real people in {noise} noise at 10 dB (--data)",
            0.8,
            more,
            PEER,
            needs_data=True,
        )


def _stop_and_cost() -> Iterator[Figure]:
    more: Literal["more"] = "more"
    yield Figure("stop_p50", "ms", "STOP after the end of its word, median", against=PEER)
    yield Figure("stop_p90", "ms", "STOP after the end of its word, 90 of 100", 300, against=PEER)
    yield Figure("stop_heard", "", "STOP in the stream heard", 1.0, more, PEER)
    yield Figure(
        "stop_false", "/h", "STOP in running speech outside the grammar, an hour of talk", against=PEER
    )
    yield Figure("stop_near", "", "phrases with a neighbour of STOP in them taken for it", against=PEER)
    yield Figure("cost", "of real time", "judging an utterance, on one core", 0.1, against=PEER)
    yield Figure(
        "cost_stream",
        "of real time",
        "hands-free with the STOP spotter, a phrase every 3 s, on one core",
        against=PEER,
    )


FIGURES = tuple(_figures())


@dataclass(frozen=True, slots=True)
class Clip:
    """One recording."""

    command: str
    """The intent that it says; empty for none."""
    said: str
    samples: Samples


@contextmanager
def prepare(context: Context) -> Iterator[Sides]:
    """The voices are made once; recordings are read where there are any."""
    voices = natural([*SPOKEN, *OUTSIDE, *NEIGHBOURS])
    made = [Clip(SPOKEN.get(text, ""), text, samples) for text, samples in voices]
    amid = [Clip("", text, samples) for text, samples in natural(AMID)]
    formant = [Clip(SPOKEN[text], text, samples) for text, samples in espeak(list(SPOKEN))]
    real = list(recordings(context.data)) if context.data else []
    model = HamaModel()

    def phonemes(grammar: Grammar) -> Judge:
        return Phonemes(grammar, model)

    yield Sides(
        lambda: {
            **rates(phonemes, made, formant, real),
            **in_noise(phonemes, made, real),
            **streamed(phonemes, made, amid, real),
        },
        lambda: _peer(made, amid, formant, real),
    )


def recordings(folder: Path) -> Iterator[Clip]:
    """A folder for each word, in the folder or in its `speech_commands`."""
    among = folder / "speech_commands"
    for path in sorted((among if among.is_dir() else folder).glob("*/*")):
        if path.suffix.lower() in (".flac", ".wav"):
            word = path.parent.name.lower()
            yield Clip(word if word in REAL else "", word, read(path))


def rates(
    make: Callable[[Grammar], Judge], made: Sequence[Clip], formant: Sequence[Clip], real: Sequence[Clip]
) -> dict[str, float]:
    """Everything that is judged utterance by utterance, without noise."""
    judge = make(Grammar(COMMANDS))
    began = time.process_time()
    right, wrong, false = tally(judge, [c for c in made if c.said not in NEIGHBOURS], frozenset(COMMANDS))
    cost = (time.process_time() - began) / sum(
        len(c.samples) / RATE for c in made if c.said not in NEIGHBOURS
    )
    near = tally(judge, [c for c in made if c.said in NEIGHBOURS], frozenset(COMMANDS))[2]
    figures = {"natural": right, "natural_wrong": wrong, "outside": false, "neighbours": near, "cost": cost}
    if formant:
        figures["formant"] = tally(judge, formant, frozenset(COMMANDS))[0]
    if real:
        few = make(Grammar(REAL))
        figures["real"], _, figures["real_outside"] = tally(few, real, frozenset(REAL))
        figures["real_stop"] = tally(few, [c for c in real if c.command == "stop"], frozenset(REAL))[0]
    return figures


def in_noise(
    make: Callable[[Grammar], Judge], made: Sequence[Clip], real: Sequence[Clip]
) -> dict[str, float]:
    """The same 10 dB over noise."""
    judge, few = make(Grammar(COMMANDS)), make(Grammar(REAL))
    rng, figures = np.random.default_rng(1), {}
    some = [clip for clip in made if clip.said not in NEIGHBOURS][::2]
    spoken = [clip for clip in real if clip.command] * DRAWS
    for noise in NOISES:
        bad = [Clip(c.command, c.said, noisy(c.samples, noise, SNR, rng)) for c in some]
        figures[f"{noise}_10"], _, figures[f"{noise}_10_outside"] = tally(judge, bad, frozenset(COMMANDS))
        inside = [Clip(c.command, c.said, noisy(c.samples, noise, SNR, rng)) for c in spoken]
        if inside:
            figures[f"real_{noise}_10"] = tally(few, inside, frozenset(REAL))[0]
    return figures


def tally(judge: Judge, clips: Sequence[Clip], heeded: frozenset[str]) -> tuple[float, float, float]:
    """Of those that say a command the share that is understood, and taken for another; of the others the share accepted."""
    right = wrong = false = inside = 0
    for clip in clips:
        found = judge.judge(clip.samples, heeded)
        accepted = found.command if found is not None and found.accepted else ""
        inside += bool(clip.command)
        right += bool(clip.command) and accepted == clip.command
        wrong += bool(clip.command) and accepted not in ("", clip.command)
        false += not clip.command and accepted != ""
    outside = len(clips) - inside
    return (
        right / inside if inside else math.nan,
        wrong / inside if inside else math.nan,
        false / outside if outside else math.nan,
    )


def streamed(
    make: Callable[[Grammar], Judge], made: Sequence[Clip], amid: Sequence[Clip], real: Sequence[Clip]
) -> dict[str, float]:
    """Recognition of a stream: latency of STOP, false alarms, and cost."""
    stops = [clip for clip in made if clip.said == "stop"]
    talk = [clip for clip in made if clip.said in OUTSIDE]
    few = [clip for clip in made if clip.command and clip.command != "stop"][::11]
    late, _, _ = listen(make(Grammar(COMMANDS)), COMMANDS, stops)
    _, events, _ = listen(make(Grammar(COMMANDS)), COMMANDS, talk)
    _, _, cost = listen(make(Grammar(COMMANDS)), COMMANDS, [*stops, *few, *talk[::11]])
    hours = sum(len(clip.samples) / RATE for clip in talk) / 3600
    _, near, _ = listen(make(Grammar(COMMANDS)), COMMANDS, amid)
    figures = {
        "stop_p50": percentile(late, 0.5) * 1e3 if late else math.nan,
        "stop_p90": percentile(late, 0.9) * 1e3 if late else math.nan,
        "stop_heard": len(late) / len(stops),
        "stop_false": len(_stopped(events)) / hours,
        "stop_near": len(_stopped(near)) / len(amid),
        "cost_stream": cost,
    }
    if real:
        inside = [clip for clip in real if clip.command]
        _, events, _ = listen(make(Grammar(REAL)), REAL, inside)
        understood = {
            place
            for place, event, _ in events
            if isinstance(event, Result) and event.command == inside[place].command
        }
        figures["real_streamed"] = len(understood) / len(inside)
    return figures


Events = list[tuple[int, Event, float]]
"""Clip, event, and time [s]."""


def _stopped(events: Events) -> set[int]:
    """The clips in which STOP was heard."""
    return {place for place, event, _ in events if isinstance(event, Result) and event.command == "stop"}


def listen(
    judge: Judge, phrases: dict[str, tuple[str, ...]], clips: Sequence[Clip]
) -> tuple[list[float], Events, float]:
    """Latency of each `stop` after its end [s], all events of words, and the cost as a share of real time."""
    told: Events = []
    heard: list[Event] = []
    hearing = SpeechPipeline(Grammar(phrases), judge, heard.append)
    hearing.heed(frozenset(phrases))
    rng, now, late, began = np.random.default_rng(2), 0.0, [], time.process_time()
    for place, clip in enumerate(clips):
        quiet = np.zeros(max(RATE, 3 * RATE - len(clip.samples)), np.float32)
        samples = np.concatenate((clip.samples, quiet))
        samples += (1e-4 * rng.standard_normal(len(samples))).astype(np.float32)
        over = now + _end(clip.samples)
        first = math.inf
        for part, at in chunks(samples, now):
            heard.clear()
            hearing.feed(part, at)
            told += [(place, event, at) for event in heard if isinstance(event, Result | Rejected)]
            if any(isinstance(event, Result) and event.command == "stop" for event in heard):
                first = min(first, at)
        if first < math.inf:
            late.append(max(0.0, first - over))
        now += len(samples) / RATE
    return late, told, (time.process_time() - began) / max(now, 1e-9)


def _end(samples: Samples) -> float:
    """Where the word's loudness falls for good below a thirtieth of its peak [s]."""
    frames = np.abs(samples[: len(samples) // 160 * 160]).reshape(-1, 160).max(axis=1)
    loud = np.flatnonzero(frames > frames.max() / 30)
    return (int(loud[-1]) + 1) * 0.01 if len(loud) else 0.0


def _peer(
    made: Sequence[Clip], amid: Sequence[Clip], formant: Sequence[Clip], real: Sequence[Clip]
) -> dict[str, float]:
    try:
        from app.inputs.voice.recognition.sphinx import Sphinx

        return {
            **rates(Sphinx, made, formant, real),
            **in_noise(Sphinx, made, real),
            **streamed(Sphinx, made, amid, real),
        }
    except (ImportError, VoiceTrouble):
        return {}
