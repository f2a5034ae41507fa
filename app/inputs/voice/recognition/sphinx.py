"""The fallback: pocketsphinx, whose model is in its wheel, with a grammar of our phrases and of words that are none of them.

It is quick and right about clean speech, and takes much for a command that is none (docs/voice.md): so its
confidence never says more than that the grammar's words came before the others.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.endpoint import Segment
from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.interfaces.speech_recognizer import Grammar, VoiceTrouble
from app.inputs.voice.recognition.ctc import Found
from app.inputs.voice.recognition.lexicon import background, pronunciations
from app.inputs.voice.recognition.spotter import Spotted
from widgets.core.language import tr

__all__ = ["Sphinx"]

SURE = 0.7
"""Confidence in whatever the grammar matched; it has no better measure of its own."""
OPEN = {"ɑ", "ɔ", "æ"}
"""Vowels of no decoy: it hears them in STOP."""
DECOYS = 12
"""So many words beside the commands: each more costs time, and takes some commands along."""
GAP = RATE // 3
"""Quiet before and after the words: it levels its ears by that [samples]."""
SPOTS = (0.12, 0.4)
"""STOP is looked for once when the voice has sunk for between so long [s]."""


class Sphinx:
    """A judge (`app.inputs.voice.recognition.hearing.Judge`)."""

    def __init__(self, grammar: Grammar) -> None:
        """`VoiceTrouble` where the package is missing or does not know a word."""
        try:
            from pocketsphinx import Decoder

            self._decoder: Any = Decoder(lm=None, loglevel="FATAL")
        except (ImportError, RuntimeError, OSError) as problem:
            raise VoiceTrouble(
                tr("The fallback recogniser cannot be loaded: {problem}.").format(problem=problem)
            ) from problem
        self._phrases = {phrase: command for command, said in grammar.phrases.items() for phrase in said}
        words = {word for phrase in self._phrases for word in phrase.split()}
        unknown = [word for word in sorted(words) if self._decoder.lookup_word(word) is None]
        if unknown:
            raise VoiceTrouble(
                tr("The fallback recogniser does not know the word {unknown!r}.").format(unknown=unknown[0])
            )
        self._urgent = frozenset(grammar.urgent)
        self._looked = -1.0
        starts = {sounds[:2] for said in self._phrases for sounds in pronunciations(said)}
        decoys = [
            word
            for word, sounds in background()
            if word not in words
            and sounds[:2] not in starts
            and not OPEN & set(sounds)
            and self._decoder.lookup_word(word)
        ]
        step = max(1, len(decoys) // DECOYS)
        choices = " | ".join([*self._phrases, *decoys[::step]])
        self._decoder.add_jsgf_string("said", f"#JSGF V1.0; grammar said; public <said> = {choices};")
        self._decoder.activate_search("said")

    def judge(self, samples: NDArray[np.float32], heeded: Collection[str]) -> Found | None:
        """What the grammar makes of it."""
        rng = np.random.default_rng(0)
        about = [(1e-3 * rng.standard_normal(GAP)).astype(np.float32) for _ in range(2)]
        heard = np.concatenate((about[0], samples, about[1]))
        raw = (np.clip(heard, -1.0, 1.0) * 32767).astype("<i2").tobytes()
        self._decoder.start_utt()
        self._decoder.process_raw(raw, no_search=False, full_utt=True)
        self._decoder.end_utt()
        found = self._decoder.hyp()
        if found is None or not found.hypstr:
            return None
        command = self._phrases.get(found.hypstr, "")
        accepted = command in heeded
        return Found(command, found.hypstr, SURE if accepted else 0.2, (), float("nan"), "")

    def spot(self, segment: Segment, now: float) -> Spotted | None:
        """Only where the words seem over: it cannot find one word amid others."""
        quiet = now - segment.ended
        if (
            not SPOTS[0] <= quiet <= SPOTS[1]
            or segment.began == self._looked
            or len(segment.samples) > 1.2 * RATE
        ):
            return None
        self._looked = segment.began
        found = self.judge(segment.samples, self._urgent)
        if found is None or not found.accepted:
            return None
        return Spotted(found.command, found.phrase, -0.5, segment.ended)

    def running(self, recent: NDArray[np.float32], now: float) -> Spotted | None:
        """Nothing: it tells words by the silence about them."""
        return None
