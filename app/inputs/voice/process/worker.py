"""Recognisers that work beside the app: in a process of their own where that can be had, else in a thread.

    voice = recognizer("phonemes")      # or "sphinx", or "vosk" with a model's folder
    voice.start(Grammar(COMMANDS), hear)

A process keeps the user interface smooth, and a fault in foreign code takes nothing with it: a process that crashes or hangs is said, and
started again once within ten minutes (`app.inputs.voice.process.breakdown`). A thread that hangs cannot be ended.
"""

from __future__ import annotations

import importlib.util
import json
import logging
import os
import sys
import threading
import time
from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import Any

from app.inputs.voice.audio.microphone import AudioSource, Microphone
from app.inputs.voice.interfaces.speech_recognizer import (
    Grammar,
    Hear,
    Result,
    SpeechRecognizer,
    State,
    VoiceTrouble,
)
from app.inputs.voice.process.breakdown import CHECK_PERIOD, Breakdowns, LifeSigns, reason
from app.inputs.voice.process.ending import end_aside
from app.inputs.voice.process.installing import install_command
from app.inputs.voice.process.running import Running
from app.inputs.voice.process.service import Service, judge_of
from app.inputs.voice.process.wire import THERE, grammar_fields, read_event
from app.inputs.voice.recognition.phrases import PHRASES
from app.inputs.voice.recognition.vosk_judge import model_fault
from widgets.core.language import VARIABLE, language, tr

__all__ = ["PACKAGES", "InProcess", "InThread", "recognizer"]

log = logging.getLogger(__name__)

PACKAGES = {"phonemes": ("hama", "voice"), "sphinx": ("pocketsphinx", "voice"), "vosk": ("vosk", "vosk")}
"""The package that each judge needs, and the extra of pilothouse that installs it."""
ROOT = Path(__file__).parents[4]


def recognizer(name: str = "phonemes", model: str = "", *, alone: bool | None = None) -> SpeechRecognizer:
    """The recogniser of that name in `PACKAGES`; `alone` in a process of its own, None where the system has such.

    `model` is the folder of a model, for one that has none of its own.
    """
    if name not in PACKAGES:
        raise VoiceTrouble(f"There is no recogniser {name!r}; there are {', '.join(PACKAGES)}.")
    if alone is None:
        alone = (
            bool(sys.executable)
            and not getattr(sys, "frozen", False)
            and not hasattr(sys, "getandroidapilevel")
        )
    return InProcess(name, model=model) if alone else InThread(name, model=model)


def _missing(name: str, model: str) -> str:
    package, extra = PACKAGES[name]
    if importlib.util.find_spec(package) is None:
        return f"Voice needs the package {package}, which is not installed: {install_command(extra)}."
    return model_fault(model) if name == "vosk" else ""


def _languages(name: str) -> tuple[str, ...]:
    """Vosk understands the language of its model, which it is given the words of."""
    return tuple(PHRASES) if name == "vosk" else ("en",)


def _engine(name: str, model: str) -> str:
    return f"{name}={model}" if model else name


def _checked(missing: str, grammar: Grammar, languages: Collection[str]) -> None:
    if missing:
        raise VoiceTrouble(missing)
    if grammar.language not in languages:
        raise VoiceTrouble(
            f"This recogniser has no {grammar.language!r}; it understands {', '.join(languages)}."
        )


def _until(over: threading.Event, hear: Hear) -> Hear:
    """Tell what comes until it is over: what ends beside the glass is heard no more."""
    return lambda event: None if over.is_set() else hear(event)


class InThread:
    """In a thread of the app: on a phone, which has no processes to start."""

    def __init__(
        self,
        name: str,
        ears: Callable[[], AudioSource] = Microphone,
        now: Callable[[], float] = time.monotonic,
        model: str = "",
    ) -> None:
        """`name` is one of `PACKAGES`, `model` the folder of its model where it has none of its own."""
        self.name, self._model, self._ears, self._now = name, model, ears, now
        self.languages = _languages(name)
        self._service: Service | None = None
        self._thread: threading.Thread | None = None
        self._over = threading.Event()

    def missing(self) -> str:
        """Why it cannot work here."""
        return _missing(self.name, self._model)

    def start(self, grammar: Grammar, hear: Hear) -> None:
        """Load in the thread."""
        self.stop()
        _checked(self.missing(), grammar, self.languages)
        self._over = threading.Event()
        hear = _until(self._over, hear)
        engine = _engine(self.name, self._model)
        self._service = Service(grammar, self._ears(), lambda wanted: judge_of(engine, wanted), hear)
        self._thread = threading.Thread(
            target=self._run, args=(self._service, hear), name="voice", daemon=True
        )
        self._thread.start()

    def listen(self, *, on: bool) -> None:
        """Open or close the ears."""
        if self._service is not None:
            self._service.listen(on=on)

    def heed(self, commands: Collection[str] | None) -> None:
        """Count only these."""
        if self._service is not None:
            self._service.heed(None if commands is None else frozenset(commands))

    def stop(self) -> None:
        """End the thread."""
        self._over.set()
        service, self._service = self._service, None
        if service is not None:
            service.stop()
        thread, self._thread = self._thread, None
        end_aside(None, thread)

    def _run(self, service: Service, hear: Hear) -> None:
        breakdowns, again = Breakdowns(), True
        while again:
            try:
                service.run()
            except Exception as problem:
                why = reason(f"{type(problem).__name__}: {problem}")
                again, sentence = breakdowns.sentence("crashed", why, self._now())
                log.warning("%s", sentence, exc_info=problem)
                hear(State("starting" if again else "failed", sentence))
            else:
                return


class InProcess:
    """In a process of its own."""

    def __init__(
        self,
        name: str,
        recordings: Sequence[Path] = (),
        command: Sequence[str] = (),
        now: Callable[[], float] = time.monotonic,
        model: str = "",
    ) -> None:
        """`recordings` are heard in place of the microphone; `command` is run in place of `app.inputs.voice.process.child`.

        `model` is the folder of a model where the recogniser has none of its own.
        """
        self.name, self._model, self._now = name, model, now
        self.languages = _languages(name)
        self._command = list(command) or [
            sys.executable,
            "-m",
            "app.inputs.voice.process.child",
            _engine(name, model),
            *map(str, recordings),
        ]
        self._lock = threading.Lock()
        self._process: Running | None = None
        self._life: threading.Thread | None = None
        self._said: dict[str, dict[str, Any]] = {}
        self._over = threading.Event()

    def missing(self) -> str:
        """Why it cannot work here."""
        return _missing(self.name, self._model)

    def start(self, grammar: Grammar, hear: Hear) -> None:
        """Start the process."""
        self.stop()
        _checked(self.missing(), grammar, self.languages)
        self._over, self._said = threading.Event(), {}
        process = self._spawn(grammar, self._over)
        self._life = threading.Thread(
            target=self._live,
            args=(process, grammar, _until(self._over, hear), self._over),
            name="voice",
            daemon=True,
        )
        self._life.start()

    def listen(self, *, on: bool) -> None:
        """Open or close the ears."""
        self._order("listen", on)

    def heed(self, commands: Collection[str] | None) -> None:
        """Count only these."""
        self._order("heed", None if commands is None else sorted(commands))

    def stop(self) -> None:
        """End the process."""
        with self._lock:
            self._over.set()
            process, self._process = self._process, None
        if process is not None:
            process.wake()
        life, self._life = self._life, None
        end_aside(None, life)

    def _spawn(self, grammar: Grammar, over: threading.Event) -> Running:
        paths = [str(ROOT), os.environ.get("PYTHONPATH", "")]
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "PYTHONIOENCODING": "utf-8",
            VARIABLE: language.name,
        }
        environment |= dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
        try:
            process = Running(self._command, environment)
        except OSError as problem:
            raise VoiceTrouble(
                tr("The voice process cannot be started: {problem}.").format(problem=problem)
            ) from problem
        with self._lock:  # nobody's order may overtake the grammar, nor what it was told before
            self._send(process, grammar_fields(grammar))
            for order in self._said.values():
                self._send(process, order)
            if not over.is_set():
                self._process = process
        return process

    def _order(self, key: str, value: Any) -> None:
        with self._lock:
            self._said[key] = {key: value}
            if self._process is not None:
                self._send(self._process, {key: value})

    def _send(self, process: Running, fields: dict[str, Any]) -> None:
        process.order(json.dumps(fields))

    def _live(self, process: Running, grammar: Grammar, hear: Hear, over: threading.Event) -> None:
        """The thread that cares for the process: tells its events, and starts it again where that helps."""
        breakdowns = Breakdowns()
        while True:
            signs = LifeSigns(self._now())
            failed = self._events(process, signs, grammar, hear, over)
            if not signs.hangs:
                process.end()
            if failed or over.is_set():
                process.end()
                return
            word, why = ("hung", signs.why) if signs.hangs else ("crashed", process.last_words)
            again, sentence = breakdowns.sentence(word, why, self._now())
            log.warning("%s", sentence)
            hear(State("starting" if again else "failed", sentence))
            process.end(hangs=True)
            if not again or over.is_set():
                return
            try:
                process = self._spawn(grammar, over)
            except VoiceTrouble as trouble:
                hear(State("failed", str(trouble)))
                return

    def _events(
        self, process: Running, signs: LifeSigns, grammar: Grammar, hear: Hear, over: threading.Event
    ) -> bool:
        """Until the process ends or hangs; whether it had said that it fails."""
        failed = False
        while (line := process.line(CHECK_PERIOD)) is not None and not over.is_set():
            if line:
                signs.heard(self._now())
            signs.beat(self._now())
            if signs.hangs:
                return False
            if signs.asks():
                process.order(THERE)
            try:
                event = read_event(line)
            except ValueError:
                continue  # a foreign library printed something
            if isinstance(event, Result) and event.command not in grammar.phrases:
                continue  # nobody asked for that
            failed = isinstance(event, State) and event.word == "failed"
            signs.loading = isinstance(event, State) and event.word == "starting"
            hear(event)
        return failed
