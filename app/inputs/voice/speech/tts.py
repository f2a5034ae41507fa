"""Text to speech on a desktop: a voice in a process of its own, which is given a line and reports when it began and ended.

speaker = speaker_of("natural"); speaker.start(tell); speaker.say("Go home?", 1.0); speaker.stop()
"""

from __future__ import annotations

import contextlib
import importlib.util
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from app.inputs.voice.interfaces.speaker import Speaker, Tell
from app.inputs.voice.process.ending import end_aside
from app.inputs.voice.process.installing import install_command
from app.inputs.voice.speech import espeak
from widgets.core.language import mark, tr

__all__ = ["VOICES", "SpeakerProcess", "choose_voice", "speaker_of"]

VOICES: dict[str, str] = {"natural": mark("Natural"), "clear": mark("Clear, like a machine")}
"""Voices of a desktop, with their names for the operator."""
ROOT = Path(__file__).parents[4]
NO_HIBARI = f"Talking needs the packages hibari-tts and miniaudio: {install_command('voice')}."
NO_ESPEAK = f"This voice needs the program espeak-ng, or {install_command('espeak')}."
CRASHED = mark("The voice that talks crashed and is silent. Choose it again to start it again.")


def speaker_of(voice: str) -> Speaker:
    """A voice of `VOICES`; KeyError for another."""
    _ = VOICES[voice]
    return SpeakerProcess(voice)


def choose_voice(voice: str, make: Callable[[str], Speaker] = speaker_of) -> tuple[Speaker, str]:
    """That voice of `VOICES`, and an empty text; else another one that works here, and one sentence why it is another.

    Where none works, the one that is wanted, which says itself what it lacks.
    """
    first = make(voice)
    missing = first.missing()
    for name in VOICES if missing else ():
        other = make(name)
        if name != voice and not other.missing():
            return other, tr("{missing} “{voices}” talks instead.").format(
                missing=missing, voices=tr(VOICES[name])
            )
    return first, ""


class SpeakerProcess:
    """Speaks by `app.inputs.voice.speech.talker` in a process of its own."""

    def __init__(self, voice: str, command: Sequence[str] = ()) -> None:
        """`command` is run in place of the talker."""
        self._voice = voice
        self._command = list(command) or [sys.executable, "-m", "app.inputs.voice.speech.talker", voice]
        self._process: subprocess.Popen[str] | None = None
        self._reader: threading.Thread | None = None
        self._over = threading.Event()

    def missing(self) -> str:
        """Why it cannot speak here."""
        if self._voice == "clear":
            return "" if espeak.is_installed() else NO_ESPEAK
        found = all(importlib.util.find_spec(name) is not None for name in ("hibari", "miniaudio"))
        return "" if found and sys.executable else NO_HIBARI

    def start(self, tell: Tell) -> None:
        """Start the process."""
        self.stop()
        self._over = over = threading.Event()
        paths = [str(ROOT), os.environ.get("PYTHONPATH", "")]
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "PYTHONIOENCODING": "utf-8",
            "OMP_NUM_THREADS": "1",
        }
        self._process = process = subprocess.Popen(
            self._command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            encoding="utf-8",
            env=environment,
        )
        self._reader = threading.Thread(
            target=self._read, args=(process, tell, over), name="talk", daemon=True
        )
        self._reader.start()

    def say(self, words: str, rate: float) -> None:
        """Say it."""
        self._send({"say": words, "rate": rate})

    def hush(self) -> None:
        """Break off."""
        self._send({"hush": True})

    def stop(self) -> None:
        """End the process."""
        self._over.set()
        process, self._process = self._process, None
        reader, self._reader = self._reader, None
        end_aside(process, reader)

    def _send(self, fields: dict[str, object]) -> None:
        process = self._process
        if process is None or process.stdin is None:
            return
        with contextlib.suppress(OSError, ValueError):  # it has just ended, which the reader says
            process.stdin.write(json.dumps(fields) + "\n")
            process.stdin.flush()

    def _read(self, process: subprocess.Popen[str], tell: Tell, over: threading.Event) -> None:
        failed = False
        for line in process.stdout or ():
            try:
                word, sentence = json.loads(line)
            except (ValueError, TypeError):
                continue  # a foreign library printed something
            failed = failed or word == "failed"
            if over.is_set():
                return
            tell(str(word), str(sentence))
        if not failed and not over.is_set():
            tell("failed", tr(CRASHED))
