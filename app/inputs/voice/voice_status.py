"""Status of voice input: what its recogniser reports of itself, of the microphone and of the noise."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal

from app.inputs.voice.interfaces.speech_recognizer import Level, State
from app.inputs.voice.voice_settings import VoiceSettings
from widgets.core.language import mark, tr

__all__ = ["CLIPPED_TIME", "CLIPS", "DEAF_NOW", "MUTED_NOW", "VoiceStatus"]

CLIPPED_TIME = 1.0
"""The microphone counts as overdriven for so long after it was measured last [s]."""
DEAF_NOW = mark("STOP by voice is not heard now; the microphone is tried again by itself.")
MUTED_NOW = mark("STOP by voice is not heard now.")
CLIPS = mark("The microphone is overdriven: speak more softly, or farther away from it.")
TOO_LOUD = mark("Too loud here for voice.")
WORDS = {"starting": mark("gets ready"), "ready": mark("hold to talk")}


class VoiceStatus:
    """Everything in the UI thread but `measure`."""

    def __init__(self, now: Callable[[], float], settings: Callable[[], VoiceSettings]) -> None:
        """`now` is our clock [s], `settings` gives what is chosen at the moment."""
        self._now, self._settings = now, settings
        self.state = State("off")
        """What the recogniser reported last."""
        self.level = Level(-math.inf, math.nan, math.nan)
        """How loud it was last."""
        self.loud = False
        """It is too loud here for voice."""
        self._clips_until = -math.inf

    def reset(self, word: str, sentence: str = "") -> None:
        """The recogniser begins or ends: what it reported before is void."""
        self.state, self.loud = State(word, sentence), False

    def measure(self, level: Level) -> None:
        """Take over how loud it is; in any thread."""
        self.level = level
        if level.clipped:
            self._clips_until = self._now() + CLIPPED_TIME

    def change(self, state: State) -> Literal["", "hears", "changed"]:
        """Take over `state`; whether the microphone hears again, or anything else changed that the operator should know."""
        before, told, deaf = self.loud, self.state.sentence, self.is_deaf
        self.state = state
        if state.word == "too loud":
            self.loud = True
        elif state.word == "listening" and state.sentence:  # reported only where it had been too loud
            self.loud = False
        news = state.sentence not in ("", told)
        if deaf and state.word == "listening":
            return "hears"
        deaf = self.is_deaf
        changed = self.loud != before or (news and (deaf or not (self.loud or before)))
        return "changed" if changed else ""

    @property
    def is_ready(self) -> bool:
        """It would hear, or hears."""
        return self.state.word in ("ready", "listening", "too loud")

    @property
    def has_lost_microphone(self) -> bool:
        """The microphone was closed because it gives nothing any more."""
        return self.state.word == "ready" and bool(self.state.sentence)

    @property
    def is_clipping(self) -> bool:
        """The microphone is overdriven."""
        return self._now() < self._clips_until

    @property
    def is_deaf(self) -> bool:
        """The microphone is open and muted; or it is to be open all the time, and it is gone."""
        return (self._settings().hands_free and self.has_lost_microphone) or self.state.word == "muted"

    def fault(self, mistaken: str) -> str:
        """Why nothing is understood, as a sentence; `mistaken` is what is wrong with the settings. Empty when all is well."""
        if self.is_deaf:
            return f"{self.state.sentence} {tr(MUTED_NOW) if self.state.word == 'muted' else tr(DEAF_NOW)}"
        if self.loud:
            return self.state.sentence or tr(TOO_LOUD)
        wrong = self.state.word in ("failed", "ready") and self.state.sentence
        return mistaken or (self.state.sentence if wrong else "")

    @property
    def standing(self) -> str:
        """How it stands, in a few words."""
        if not self._settings().on:
            return tr("off")
        if self.is_deaf:
            return tr("deaf")
        if self.loud:
            return tr("too loud")
        if self.state.word == "listening":
            return tr("listening")
        return tr(WORDS.get(self.state.word, mark("does not work")))

    def sign(self, mistaken: str, *, listening: bool) -> str:
        """For the button to talk while the microphone is open (`listening`) or not: `ready`, `listening`, `loud` or `wrong`; empty while off."""
        if not self._settings().on:
            return ""
        if self.loud and not self.is_deaf:
            return "loud"
        return "wrong" if self.fault(mistaken) else "listening" if listening else "ready"
