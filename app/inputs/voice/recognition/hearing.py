"""From samples to events: noise meter, end points, STOP spotter and scorer in a row. Knows no microphone, thread or clock."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.endpoint import Endpointer, Segment
from app.inputs.voice.audio.noise import RATE, TOO_LOUD, NoiseMeter
from app.inputs.voice.interfaces.speech_recognizer import Grammar, Hear, Level, Rejected, Result, State
from app.inputs.voice.recognition.ctc import Acoustics, Found, Scorer
from app.inputs.voice.recognition.rechecks import looks
from app.inputs.voice.recognition.spotter import RUNNING_WINDOW, STOP, Spotted, Spotter
from widgets.core.language import tr

__all__ = ["RECENT", "Judge", "Phonemes", "SpeechPipeline"]

METER_PERIOD = 0.1
"""The meter is told so often [s]."""
UNSURE_RANGE = (0.02, 0.9)
"""It is asked again, by other looks at the words, between these confidences."""
UNWITNESSED = 0.4
"""Confidence in a STOP that the network for that word does not hear."""
RECENT = RUNNING_WINDOW
"""So much of all that is heard is kept for STOP [s]."""
SAME_STOP_TIME = 0.35
"""STOP that ends within this of one that was spotted is the same [s]."""


class Judge(Protocol):
    """Understands one utterance, and STOP in part of one."""

    def judge(self, samples: NDArray[np.float32], heeded: Collection[str]) -> Found | None:
        """What was most likely said, of `heeded`; None for nothing."""
        ...

    def spot(self, segment: Segment, now: float) -> Spotted | None:
        """An urgent intent in what is said until `now` [s]; None where there is none, or where it looks later."""
        ...

    def running(self, recent: NDArray[np.float32], now: float) -> Spotted | None:
        """The same in the last `RECENT` of all that is heard, words or not; None where it finds nothing there."""
        ...


class Phonemes:
    """The judge that scores phonemes: `app.inputs.voice.recognition.ctc` and `app.inputs.voice.recognition.spotter` on one model."""

    def __init__(self, grammar: Grammar, model: Acoustics) -> None:
        """`VoiceTrouble` for a phrase whose sounds are not known."""
        self._model, self._grammar = model, grammar
        self._scorer, self._spotter = Scorer(grammar, model.tokens), Spotter(grammar, model)

    def judge(self, samples: NDArray[np.float32], heeded: Collection[str]) -> Found | None:
        """By the whole utterance; where that is close to call, by further looks at it (`app.inputs.voice.recognition.rechecks`)."""
        views = [self._model.log_probs(samples)]
        found = self._scorer.judge(views, heeded)
        if self._urgent(found):
            return self._witnessed(found, samples)
        if found is None or not UNSURE_RANGE[0] < found.confidence < UNSURE_RANGE[1]:
            return found
        for other in looks(samples):
            views.append(self._model.log_probs(other))
            alone = self._scorer.judge(views[-1:], heeded)
            if self._urgent(alone):
                return self._witnessed(alone, samples)
        return self._scorer.judge(views, heeded)

    def _witnessed(self, found: Found | None, samples: NDArray[np.float32]) -> Found | None:
        """STOP needs a second witness: amid words others sound like it."""
        if found is None or STOP not in found.phrase.split() or self._spotter.holds(samples):
            return found
        return replace(found, confidence=min(found.confidence, UNWITNESSED))

    def _urgent(self, found: Found | None) -> bool:
        """STOP in any look is STOP."""
        return found is not None and found.accepted and found.command in self._grammar.urgent

    def spot(self, segment: Segment, now: float) -> Spotted | None:
        """By its last second, at the moments when a word may have ended."""
        return self._spotter.search(segment, now)

    def running(self, recent: NDArray[np.float32], now: float) -> Spotted | None:
        """By a network for the one word STOP."""
        return self._spotter.running(recent, now)


class SpeechPipeline:
    """Fed with samples; tells events. All in one thread."""

    def __init__(self, grammar: Grammar, judge: Judge, tell: Hear) -> None:
        """`tell` is given each event."""
        self._grammar, self._judge, self._tell = grammar, judge, tell
        self._meter, self._points = NoiseMeter(), Endpointer()
        self._every = frozenset(grammar.phrases)
        self._heeded: frozenset[str] | None = None
        self._metered = -METER_PERIOD
        self._told_loud = False
        self._spotted: Spotted | None = None
        self._recent: NDArray[np.float32] = np.zeros(0, np.float32)

    @property
    def heeded(self) -> frozenset[str]:
        """The intents that count now."""
        heeded = self._every - self._grammar.asked if self._heeded is None else self._heeded
        return (heeded | self._grammar.urgent) & self._every

    def heed(self, commands: Collection[str] | None) -> None:
        """Count only these from now on; None for all that need no question."""
        self._heeded = None if commands is None else frozenset(commands)

    def feed(self, samples: NDArray[np.float32], at: float) -> None:
        """The next samples at 16 kHz, -1 to 1, of which the last was heard at `at` [s]."""
        over = self._points.feed(samples, at)
        self._meter.feed(samples, at, speaking=self._points.speaking)
        self._show(at)
        for segment in over:
            self._understand(segment)
        self._recent = np.concatenate((self._recent, samples))[-int(RECENT * RATE) :]
        self._look(self._points.so_far(), at)

    def finish(self, at: float) -> None:
        """The ears close: judge what was begun."""
        self._recent = np.zeros(0, np.float32)
        segment = self._points.finish()
        if segment is not None:
            self._understand(segment)
        self._meter.rest()
        self._tell(Level(float("-inf"), self._meter.noise, self._meter.snr))

    def _show(self, at: float) -> None:
        if at - self._metered >= METER_PERIOD - 1e-3:
            self._metered = at
            self._tell(self._meter.level(speaking=self._points.speaking))
        if self._meter.too_loud != self._told_loud:
            self._told_loud = self._meter.too_loud
            word = "too loud" if self._told_loud else "listening"
            sentence = tr("Too loud here for voice: speech is {snr:.0f} dB over the noise.").format(
                snr=self._meter.snr
            )
            self._tell(
                State(word, sentence if self._told_loud else tr("It is quiet enough for voice again."))
            )

    def _look(self, segment: Segment | None, at: float) -> None:
        """STOP is looked for in all that is heard, and even where it is too loud for anything else: it is never forbidden."""
        spotted = self._judge.running(self._recent, at)
        if spotted is None and segment is not None:
            spotted = self._judge.spot(segment, at)
        if spotted is None or self._same(spotted):
            return
        self._spotted = spotted
        confidence = max(0.5, min(1.0, 1.0 + spotted.fit / 2))
        self._tell(
            Result(
                spotted.command,
                spotted.phrase,
                confidence,
                began=segment.began if segment is not None else math.nan,
                ended=spotted.ended,
                snr=self._meter.snr,
                early=True,
                detail={"fit": round(spotted.fit, 2)},
            )
        )

    def _same(self, spotted: Spotted) -> bool:
        """It was told already: looks at the same word differ a little in when it ended."""
        return self._spotted is not None and spotted.ended < self._spotted.ended + SAME_STOP_TIME

    def _understand(self, segment: Segment) -> None:
        spotted = self._spotted
        again = spotted is not None and spotted.ended >= segment.began - SAME_STOP_TIME
        if not segment.whole:
            if not again:
                self._tell(Rejected(tr("That was too long for a command."), ended=segment.ended))
            return
        found = self._judge.judge(segment.samples, self._every)
        snr = self._meter.heard(segment.samples)
        if found is None:
            self._tell(Rejected(tr("Nothing was understood."), ended=segment.ended))
        elif (again and found.command in self._grammar.urgent) or (again and not found.accepted):
            return
        else:
            self._tell(self._verdict(found, segment, snr))

    def _verdict(self, found: Found, segment: Segment, snr: float) -> Result | Rejected:
        if not found.accepted:
            reason = tr("That was no command.")
        elif found.command not in self.heeded:
            asked = found.command in self._grammar.asked
            reason = (
                tr("No question is open: “{phrase}” counts only as an answer.").format(phrase=found.phrase)
                if asked
                else (tr("“{phrase}” does not count now.").format(phrase=found.phrase))
            )
        elif snr < TOO_LOUD and found.command not in self._grammar.urgent:
            reason = tr("It is too loud here to be sure.")
        else:
            detail = {"explains": round(found.explains, 2), "rival": found.rival}
            return Result(
                found.command,
                found.phrase,
                found.confidence,
                began=segment.began,
                ended=segment.ended,
                alternatives=found.alternatives,
                snr=snr,
                detail=detail,
            )
        return Rejected(reason, found.command, found.confidence, segment.ended)
