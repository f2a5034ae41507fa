"""Recognisers that work beside the app: in a process of their own where that can be had, else in a thread.

    voice = recognizer("phonemes")      # or "sphinx"
    voice.start(Grammar(COMMANDS), hear)

A process keeps the user interface smooth, and a fault in foreign code takes nothing with it: it is said, and the process is
started again once.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Collection, Sequence
from pathlib import Path
from typing import Any

from app.voice.ending import end, end_aside
from app.voice.microphone import Ears, Microphone
from app.voice.recognizer import Grammar, Hear, Result, State, VoiceRecognizer, VoiceTrouble
from app.voice.service import Service, judge_of
from app.voice.wire import grammar_fields, read_event

__all__ = ["PACKAGES", "InProcess", "InThread", "recognizer"]

PACKAGES = {"phonemes": "hama", "sphinx": "pocketsphinx"}
"""What each judge needs."""
AGAIN = "Voice recognition crashed and is started again."
OVER = "Voice recognition crashed twice and is off. Switch it on again, or command by touch."
ROOT = Path(__file__).parents[2]


def recognizer(name: str = "phonemes", *, alone: bool | None = None) -> VoiceRecognizer:
    """The recogniser of that name in `PACKAGES`; `alone` in a process of its own, None where the system has such."""
    if name not in PACKAGES:
        raise VoiceTrouble(f"There is no recogniser {name!r}; there are {', '.join(PACKAGES)}.")
    if alone is None:
        alone = (
            bool(sys.executable)
            and not getattr(sys, "frozen", False)
            and not hasattr(sys, "getandroidapilevel")
        )
    return InProcess(name) if alone else InThread(name)


def _missing(name: str) -> str:
    package = PACKAGES[name]
    if importlib.util.find_spec(package) is None:
        return f"Voice needs the package {package}, which is not installed: pip install pilothouse[voice]."
    return ""


def _checked(name: str, grammar: Grammar, languages: Collection[str]) -> None:
    if _missing(name):
        raise VoiceTrouble(_missing(name))
    if grammar.language not in languages:
        raise VoiceTrouble(
            f"This recogniser has no {grammar.language!r}; it understands {', '.join(languages)}."
        )


def _until(over: threading.Event, hear: Hear) -> Hear:
    """Tell what comes until it is over: what ends beside the glass is heard no more."""
    return lambda event: None if over.is_set() else hear(event)


class InThread:
    """In a thread of the app: on a phone, which has no processes to start."""

    languages: tuple[str, ...] = ("en",)

    def __init__(self, name: str, ears: Callable[[], Ears] = Microphone) -> None:
        """`name` is one of `PACKAGES`."""
        self.name, self._ears = name, ears
        self._service: Service | None = None
        self._thread: threading.Thread | None = None
        self._over = threading.Event()

    def missing(self) -> str:
        """Why it cannot work here."""
        return _missing(self.name)

    def start(self, grammar: Grammar, hear: Hear) -> None:
        """Load in the thread."""
        self.stop()
        _checked(self.name, grammar, self.languages)
        self._over = threading.Event()
        hear = _until(self._over, hear)
        self._service = Service(grammar, self._ears(), lambda wanted: judge_of(self.name, wanted), hear)
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
        for sentence in (AGAIN, OVER):
            try:
                service.run()
            except Exception:  # noqa: BLE001 - whatever a foreign library raises, it is said and the app goes on
                hear(State("starting" if sentence == AGAIN else "failed", sentence))
            else:
                return


class InProcess:
    """In a process of its own."""

    languages: tuple[str, ...] = ("en",)

    def __init__(self, name: str, recordings: Sequence[Path] = (), command: Sequence[str] = ()) -> None:
        """`recordings` are heard in place of the microphone; `command` is run in place of `app.voice.child`."""
        self.name = name
        self._command = list(command) or [
            sys.executable,
            "-m",
            "app.voice.child",
            name,
            *map(str, recordings),
        ]
        self._lock = threading.Lock()
        self._process: subprocess.Popen[str] | None = None
        self._reader: threading.Thread | None = None
        self._said: dict[str, dict[str, Any]] = {}
        self._over = threading.Event()

    def missing(self) -> str:
        """Why it cannot work here."""
        return _missing(self.name)

    def start(self, grammar: Grammar, hear: Hear) -> None:
        """Start the process."""
        self.stop()
        _checked(self.name, grammar, self.languages)
        self._over, self._said = threading.Event(), {}
        process = self._spawn(grammar, self._over)
        self._reader = threading.Thread(
            target=self._read,
            args=(process, grammar, _until(self._over, hear), self._over),
            name="voice",
            daemon=True,
        )
        self._reader.start()

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
        reader, self._reader = self._reader, None
        end_aside(process, reader)

    def _spawn(self, grammar: Grammar, over: threading.Event) -> subprocess.Popen[str]:
        paths = [str(ROOT), os.environ.get("PYTHONPATH", "")]
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "PYTHONIOENCODING": "utf-8",
        }
        environment |= dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
        try:
            process = subprocess.Popen(
                self._command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                encoding="utf-8",
                errors="replace",
                env=environment,
            )
        except OSError as problem:
            raise VoiceTrouble(f"The voice process cannot be started: {problem}.") from problem
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

    def _send(self, process: subprocess.Popen[str], fields: dict[str, Any]) -> None:
        try:
            if process.stdin is not None:
                process.stdin.write(json.dumps(fields) + "\n")
                process.stdin.flush()
        except (OSError, ValueError):
            pass  # it has just ended, which the reader says

    def _read(
        self, process: subprocess.Popen[str], grammar: Grammar, hear: Hear, over: threading.Event
    ) -> None:
        for sentence in (AGAIN, OVER):
            failed = self._events(process, grammar, hear, over)
            end(process)
            if failed or over.is_set():
                return
            hear(State("starting" if sentence == AGAIN else "failed", sentence))
            if sentence == AGAIN:
                try:
                    process = self._spawn(grammar, over)
                except VoiceTrouble as trouble:
                    hear(State("failed", str(trouble)))
                    return

    def _events(
        self, process: subprocess.Popen[str], grammar: Grammar, hear: Hear, over: threading.Event
    ) -> bool:
        """Until the process ends; whether it had said that it fails."""
        failed = False
        for line in process.stdout or ():
            if over.is_set():
                break
            try:
                event = read_event(line)
            except ValueError:
                continue  # a foreign library printed something
            if isinstance(event, Result) and event.command not in grammar.phrases:
                continue  # nobody asked for that
            failed = isinstance(event, State) and event.word == "failed"
            hear(event)
        return failed
