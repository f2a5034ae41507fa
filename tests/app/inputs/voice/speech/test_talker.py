"""The process that talks, and what starts it; the last test has a real voice say something into nothing."""

from __future__ import annotations

import json
import queue
import sys
import threading
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.inputs.voice.audio.sound_files import chunks, resampled
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Result, VoiceTrouble
from app.inputs.voice.process.ending import wait_for_ends
from app.inputs.voice.recognition.hearing import Phonemes, SpeechPipeline
from app.inputs.voice.recognition.lexicon import COMMANDS
from app.inputs.voice.recognition.model import HamaModel
from app.inputs.voice.speech import espeak
from app.inputs.voice.speech import tts as module
from app.inputs.voice.speech.talker import NO_SPEAKER, play, serve
from app.inputs.voice.speech.tts import CRASHED, NO_ESPEAK, SpeakerProcess, speaker_of
from app.inputs.voice.talkback import aloud
from tests.lacking import package

SOUND = np.full(2400, 0.5, np.float32)


def test_each_line_is_said_and_told_when_it_began_and_ended() -> None:
    told, said, over = [], [], threading.Event()

    def speak(words: str, rate: float, hushed: threading.Event) -> None:
        said.append((words, rate))
        over.set()

    def lines() -> Any:
        yield json.dumps({"say": "Go home?", "rate": 1.2})
        over.wait(5)

    assert serve(speak, lines(), lambda *words: told.append(words)) == 0  # type: ignore[arg-type]
    assert said == [("Go home?", 1.2)]
    assert told == [("began", "Go home?"), ("ended", "Go home?")]


def test_a_newer_line_breaks_off_the_one_before() -> None:
    told, begun = [], threading.Event()

    def speak(words: str, rate: float, hushed: threading.Event) -> None:
        begun.set()
        if words == "One.":
            assert hushed.wait(5)

    def lines() -> Any:
        yield json.dumps({"say": "One."})
        begun.wait(5)
        begun.clear()
        yield json.dumps({"say": "Two."})
        begun.wait(5)

    serve(speak, lines(), lambda *words: told.append(words))  # type: ignore[arg-type]
    assert [words for word, words in told if word == "began"] == ["One.", "Two."]


def test_without_a_loudspeaker_it_says_so_and_ends() -> None:
    told = []

    def speak(words: str, rate: float, hushed: threading.Event) -> None:
        raise VoiceTrouble(NO_SPEAKER)

    started = threading.Event()

    def lines() -> Any:
        yield json.dumps({"say": "One."})
        started.wait(0.2)

    assert serve(speak, lines(), lambda *words: told.append(words)) == 1  # type: ignore[arg-type]
    assert told[-1] == ("failed", NO_SPEAKER)


class Device:
    """A loudspeaker of miniaudio that takes all at once."""

    backend = "Made up"

    def __init__(self, **_: Any) -> None:
        self.heard, self.closed = b"", False

    def start(self, source: Any) -> None:
        try:
            while True:
                self.heard += source.send(400)
        except StopIteration:
            return

    def close(self) -> None:
        self.closed = True


def audio(device: Any) -> Any:
    return SimpleNamespace(
        PlaybackDevice=lambda **_: device,
        SampleFormat=SimpleNamespace(SIGNED16=1),
        MiniaudioError=type("MiniaudioError", (Exception,), {}),
    )


def test_all_of_a_sound_is_played_and_the_device_closed() -> None:
    device = Device()
    play(SOUND, 24000, threading.Event(), audio(device))
    played = np.frombuffer(device.heard, "<i2")
    assert len(played) > len(SOUND)
    assert played[: len(SOUND)].min() > 16000
    assert device.closed


def test_hushed_it_is_broken_off() -> None:
    device, hushed = Device(), threading.Event()
    hushed.set()
    play(SOUND, 24000, hushed, audio(device))
    assert device.heard == b""


def test_miniaudios_own_silence_is_no_loudspeaker() -> None:
    device = Device()
    device.backend = "Null"
    with pytest.raises(VoiceTrouble, match="no loudspeaker"):
        play(SOUND, 24000, threading.Event(), audio(device))
    assert device.closed


def test_what_a_voice_needs_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(espeak.shutil, "which", lambda _: None)
    monkeypatch.setattr(module.importlib.util, "find_spec", lambda _: None)
    assert speaker_of("clear").missing() == NO_ESPEAK
    assert "hibari-tts" in speaker_of("natural").missing()
    with pytest.raises(KeyError):
        speaker_of("soprano")


def test_a_process_that_ends_by_itself_is_said() -> None:
    told = queue.SimpleQueue[tuple[str, str]]()
    mouth = SpeakerProcess("natural", [sys.executable, "-c", "print('no event')"])
    mouth.start(lambda *words: told.put(words))
    assert told.get(timeout=10) == ("failed", CRASHED)
    mouth.say("One.", 1.0)
    mouth.stop()
    mouth.stop()
    wait_for_ends()


def test_the_real_voice_has_a_process_of_its_own_and_says_where_it_cannot_be_heard() -> None:
    package("hibari")
    told = queue.SimpleQueue[tuple[str, str]]()
    mouth = speaker_of("natural")
    mouth.start(lambda *words: told.put(words))
    try:
        mouth.say("Go home?", 1.0)
        assert told.get(timeout=30) == ("began", "Go home?")
        word, sentence = told.get(timeout=30)
        assert (word, sentence) == ("ended", "Go home?") or (word == "failed" and "loudspeaker" in sentence)
    finally:
        mouth.stop()
        wait_for_ends()


def test_nothing_that_it_says_is_taken_for_stop_by_the_microphone() -> None:
    hibari = package("hibari")
    package("hama")
    judge = Phonemes(Grammar(COMMANDS), HamaModel())
    voice = hibari.Hibari()

    def heard(words: str) -> list[str]:
        told: list[Any] = []
        hearing = SpeechPipeline(Grammar(COMMANDS), judge, told.append)
        hearing.heed(frozenset())
        rest = np.random.default_rng(1).normal(0.0, 1e-3, 12000).astype(np.float32)
        sound = resampled(np.asarray(voice(words, seed=1), np.float32), 24000)
        for part, at in chunks(np.concatenate((rest, sound, rest, rest))):
            hearing.feed(part, at)
        return [one.command for one in told if isinstance(one, Result)]

    said = ("STOP is pressed.", "The robot is stopped.", "Emergency stop was released.")
    assert [heard(aloud(words)) for words in said] == [[], [], []]
    assert heard("stop") == ["stop"], "this microphone hears nothing at all"
