"""The service that runs while voice is on: takes orders, opens the microphone, feeds a judge, sends events."""

from __future__ import annotations

import math
import queue
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.microphone import AudioSource
from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Hear, State, VoiceTrouble
from app.inputs.voice.recognition.hearing import Judge, SpeechPipeline

__all__ = ["JUDGES", "LINGER_TIME", "MUTED", "Service", "judge_of"]

LINGER_TIME = 0.25
"""The ears stay open for so long after they were told to close: a thumb is up before the last sound is out [s]."""
READ_TIMEOUT = 0.1
"""An order waits at most so long while the ears are open [s]."""
MUTED_TIMEOUT, MUTED_TIMEOUT_AT_END = 3.0, 0.5
"""A microphone that has given not one sound for so long since it was opened is muted; when it is closed again, after so long [s]. One that
was heard is not: some give nothing at all between the words."""
MUTED = "The microphone gives nothing but silence: it is muted, or the system does not let this app hear it."


def judge_of(engine: str, grammar: Grammar) -> Judge:
    """The judge of an engine, a key of `JUDGES` with its model after `=` where it needs one; `VoiceTrouble` when it cannot work here."""
    name, _, model = engine.partition("=")
    return JUDGES[name](grammar, model)


def _phonemes(grammar: Grammar, _: str) -> Judge:
    from app.inputs.voice.recognition.hearing import Phonemes
    from app.inputs.voice.recognition.model import HamaModel

    return Phonemes(grammar, HamaModel())


def _sphinx(grammar: Grammar, _: str) -> Judge:
    from app.inputs.voice.recognition.sphinx import Sphinx

    return Sphinx(grammar)


def _vosk(grammar: Grammar, model: str) -> Judge:
    from app.inputs.voice.recognition.vosk_judge import VoskJudge

    return VoskJudge(grammar, model)


JUDGES: dict[str, Callable[[Grammar, str], Judge]] = {"phonemes": _phonemes, "vosk": _vosk, "sphinx": _sphinx}
"""What can judge speech, by name; called with the grammar and the model's folder, empty where none is needed."""


@dataclass(frozen=True, slots=True)
class _Order:
    do: str
    value: Any = None


class Service:
    """`run` in a thread or process of its own; the other methods from any thread."""

    def __init__(
        self,
        grammar: Grammar,
        ears: AudioSource,
        make: Callable[[Grammar], Judge],
        tell: Hear,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        """`make` loads the judge, in `run`'s thread."""
        self._grammar, self._ears, self._make, self._tell, self._now = grammar, ears, make, tell, now
        self._orders: queue.SimpleQueue[_Order] = queue.SimpleQueue()
        self._until = -1.0
        self._flat = 0.0
        self._heeded: frozenset[str] | None = None
        self._loading = True

    def listen(self, *, on: bool) -> None:
        """Open or close the ears."""
        self._orders.put(_Order("listen", on))

    def heed(self, commands: frozenset[str] | None) -> None:
        """Count only these from now on."""
        self._orders.put(_Order("heed", commands))

    def ask(self, answer: Callable[[], object]) -> None:
        """Have `run` answer, so that whoever asks knows that it does not hang; while it loads it is answered here and now."""
        if self._loading:
            answer()
        else:
            self._orders.put(_Order("ask", answer))

    def stop(self) -> None:
        """Have `run` end."""
        self._orders.put(_Order("stop"))

    def run(self) -> None:
        """Until `stop`. After a fault it may be run again, and goes on as it was told before."""
        listens, self._until = self._until == float("inf"), -1.0
        self._loading = True
        self._tell(State("starting"))
        try:
            hearing = SpeechPipeline(self._grammar, self._make(self._grammar), self._tell)
        except VoiceTrouble as trouble:
            self._tell(State("failed", str(trouble)))
            return
        self._loading = False
        hearing.heed(self._heeded)
        self._tell(State("ready"))
        try:
            if listens:
                self._listen(hearing, on=True)
            while self._turn(hearing):
                pass
        finally:
            self._ears.stop()

    def _turn(self, hearing: SpeechPipeline) -> bool:
        """One order or one block of samples; False at the end. Sleeps in the queue while the ears are closed."""
        open_ = self._until >= 0.0
        try:
            order = self._orders.get(block=not open_)
        except queue.Empty:
            return self._hear(hearing)
        if order.do == "heed":
            self._heeded = order.value
            hearing.heed(order.value)
        elif order.do == "listen":
            self._listen(hearing, on=order.value)
        elif order.do == "ask":
            order.value()
        return order.do != "stop"

    def _listen(self, hearing: SpeechPipeline, *, on: bool) -> None:
        if on and self._until < 0.0:
            try:
                self._ears.start()
            except VoiceTrouble as trouble:
                self._tell(State("ready", str(trouble)))
                return
            self._flat = 0.0
            self._tell(State("listening"))
        if on:
            self._until = float("inf")
        elif self._until == float("inf"):
            self._until = self._now() + LINGER_TIME

    def _hear(self, hearing: SpeechPipeline) -> bool:
        sentence = ""
        try:
            heard = self._ears.read(READ_TIMEOUT)
            if heard is not None:
                self._silent(heard[0])
                hearing.feed(*heard)
        except VoiceTrouble as trouble:
            sentence, self._until = str(trouble), 0.0
        if self._now() >= self._until:
            self._until = -1.0
            self._ears.stop()
            hearing.finish(self._now())
            self._tell(State("ready", sentence or (MUTED if self._flat >= MUTED_TIMEOUT_AT_END else "")))
        return True

    def _silent(self, samples: NDArray[np.float32]) -> None:
        """How long there was nothing but silence since the ears were opened; NaN once there was a sound."""
        before = self._flat
        self._flat = before + len(samples) / RATE if not len(samples) or np.ptp(samples) == 0.0 else math.nan
        if before < MUTED_TIMEOUT <= self._flat:
            self._tell(State("muted", MUTED))
        elif before >= MUTED_TIMEOUT and math.isnan(self._flat):
            self._tell(State("listening"))
