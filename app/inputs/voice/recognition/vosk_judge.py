"""Vosk, with a model folder of the user's: a recogniser of words, given the commands as its grammar.

It needs no package of one author and no model of ours: any model from alphacephei.com/vosk/models whose dictionary has the
words of the commands. A small model looks for the commands alone; a large one, whose graph is fixed, writes down whatever was said.
"""

from __future__ import annotations

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.inputs.voice.audio.endpoint import Segment
from app.inputs.voice.audio.noise import RATE
from app.inputs.voice.interfaces.speech_recognizer import Grammar, VoiceTrouble
from app.inputs.voice.recognition.ctc import Found
from app.inputs.voice.recognition.spotter import Spotted
from widgets.core.language import mark, tr

__all__ = ["VoskJudge", "model_fault"]

MODEL_FILES = ("am/final.mdl", "final.mdl")
"""One of these is in every model's folder."""
NO_MODEL = mark("Vosk has no model yet: enter the folder of one.")
UNKNOWN_WORDS = "[unk]"
"""What a model writes for words that are none of the grammar's, where its dictionary has such an entry."""
REJECTED = 0.2
"""Confidence in what is no command that counts."""
GAP = RATE // 4
"""Silence before and after the words: the model expects some [samples]."""
SPOTS = (0.12, 0.4)
"""STOP is looked for once when the voice has sunk for between so long [s]."""
MAX_SPOTTED = 1.2
"""Longer speech is not looked at for STOP before its end [s]."""


def model_fault(folder: str) -> str:
    """Why there is no model in `folder`, in one sentence; empty where there is one."""
    if not folder:
        return tr(NO_MODEL)
    path = Path(folder).expanduser()
    if not path.is_dir():
        return tr("There is no folder {folder}: enter the folder of a Vosk model.").format(folder=folder)
    if not any((path / name).is_file() for name in MODEL_FILES):
        return tr("The folder {folder} holds no Vosk model: enter the folder of one.").format(folder=folder)
    return ""


class VoskJudge:
    """A judge (`app.inputs.voice.recognition.hearing.Judge`)."""

    def __init__(self, grammar: Grammar, folder: str) -> None:
        """`VoiceTrouble` where the package or the model is missing, or the model does not know a word."""
        if fault := model_fault(folder):
            raise VoiceTrouble(fault)
        try:
            import vosk

            vosk.SetLogLevel(-1)
            model: Any = vosk.Model(str(Path(folder).expanduser()))
        except Exception as problem:  # vosk raises no narrower kind
            raise VoiceTrouble(
                tr("The Vosk model in {folder} cannot be loaded: {problem}.").format(
                    folder=folder, problem=problem
                )
            ) from problem
        self._phrases = {phrase: command for command, said in grammar.phrases.items() for phrase in said}
        words = {word for phrase in self._phrases for word in phrase.split()}
        unknown = [word for word in sorted(words) if model.vosk_model_find_word(word) < 0]
        if unknown:
            raise VoiceTrouble(
                tr("The Vosk model in {folder} does not know the word {unknown!r}.").format(
                    folder=folder, unknown=unknown[0]
                )
            )
        phrases = json.dumps([*self._phrases, UNKNOWN_WORDS], ensure_ascii=False)
        self._recognizer: Any = vosk.KaldiRecognizer(model, RATE, phrases)
        self._recognizer.SetWords(True)
        self._urgent = frozenset(grammar.urgent)
        self._looked = -1.0
        """When the speech began that was looked at for STOP last [s]."""

    def judge(self, samples: NDArray[np.float32], heeded: Collection[str]) -> Found | None:
        """What the model makes of it; as sure as it is of its least sure word."""
        silence = np.zeros(GAP, np.float32)
        heard = np.concatenate((silence, samples, silence))
        self._recognizer.Reset()
        self._recognizer.AcceptWaveform((np.clip(heard, -1.0, 1.0) * 32767).astype("<i2").tobytes())
        result = json.loads(self._recognizer.FinalResult())
        said = str(result.get("text", "")).strip()
        if not said:
            return None
        command = self._phrases.get(said, "") or self._urgent_in(said)
        sure = min((float(word["conf"]) for word in result.get("result", ())), default=1.0)
        counts = bool(command) and command in heeded
        return Found(command, said, min(1.0, sure) if counts else REJECTED, (), float("nan"), "")

    def _urgent_in(self, said: str) -> str:
        """The urgent command in `said`, where all else in it is no word of the grammar; empty for none."""
        known = " ".join(word for word in said.split() if word != UNKNOWN_WORDS)
        command = self._phrases.get(known, "")
        return command if command in self._urgent else ""

    def spot(self, segment: Segment, now: float) -> Spotted | None:
        """Only where the words seem over: it would find STOP in the first half of a longer command."""
        quiet = now - segment.ended
        fits = SPOTS[0] <= quiet <= SPOTS[1] and len(segment.samples) <= MAX_SPOTTED * RATE
        if not fits or segment.began == self._looked:
            return None
        self._looked = segment.began
        found = self.judge(segment.samples, self._urgent)
        if found is None or not found.accepted:
            return None
        return Spotted(found.command, found.phrase, -0.5, segment.ended)

    def running(self, recent: NDArray[np.float32], now: float) -> Spotted | None:
        """Nothing: it tells words by the silence about them."""
        return None
