"""The seam between the app and whatever understands speech: a grammar goes in, events come out.

    recognizer.start(Grammar(phrases(INTENTS)), hear)   # hear(event): in any thread, must return at once
    recognizer.listen(on=True)                          # the button to talk is down, or hands-free is on
    recognizer.heed({"stop", "yes", "no"})              # a question is open
    recognizer.listen(on=False)                         # what was begun is still judged
    recognizer.stop()

Times are `time.monotonic()` [s]. Nothing is opened, run or kept before `start` and after `stop`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

__all__ = [
    "Event",
    "Grammar",
    "Hear",
    "Level",
    "Partial",
    "Rejected",
    "Result",
    "State",
    "SpeechRecognizer",
    "VoiceTrouble",
]


class VoiceTrouble(Exception):
    """Speech cannot be heard; the message is one sentence for the operator."""


@dataclass(frozen=True, slots=True)
class Grammar:
    """Phrases."""

    phrases: Mapping[str, tuple[str, ...]]
    """Phrases for each intent's name, in lower case."""
    language: str = "en"
    """ISO 639-1. A recogniser that has no such language raises `VoiceTrouble` at the start."""
    urgent: frozenset[str] = frozenset({"stop"})
    """Intents that are looked for in what is not yet said to its end."""
    asked: frozenset[str] = frozenset({"yes", "no"})
    """Intents that count only where `heed` names them."""

    def __post_init__(self) -> None:
        if not any(self.phrases.values()):
            raise ValueError("A grammar needs at least one phrase.")


@dataclass(frozen=True, slots=True)
class Partial:
    """What it looks like so far; nothing may be done for it."""

    text: str
    confidence: float = math.nan
    """0 to 1; NaN unknown."""


@dataclass(frozen=True, slots=True)
class Result:
    """An intent was said."""

    command: str
    """The intent's name."""
    said: str
    """The phrase of the grammar that was understood."""
    confidence: float
    """0 to 1, NaN unknown; 0.5 is just enough to be accepted."""
    began: float = math.nan
    """When the words began [s]; NaN unknown."""
    ended: float = math.nan
    """When they ended, or so far as they were heard [s]; NaN unknown."""
    alternatives: tuple[tuple[str, float], ...] = ()
    """Other intents, with their confidence, best first."""
    snr: float = math.nan
    """Speech over noise [dB]; NaN unknown."""
    early: bool = False
    """Found before its end was heard (`Grammar.urgent`); the same words give no second result."""
    detail: Mapping[str, Any] = field(default_factory=dict[str, Any])
    """What the response log may keep with the operator's consent, as JSON."""


@dataclass(frozen=True, slots=True)
class Rejected:
    """Something was said, and it is no command that counts now."""

    reason: str
    """One sentence: not understood, nobody asked, too loud here."""
    command: str = ""
    """The intent that it was most like; empty for none."""
    confidence: float = math.nan
    ended: float = math.nan


@dataclass(frozen=True, slots=True)
class Level:
    """How loud it is, about ten times a second while listening."""

    level: float
    """Of the last tenth of a second [dB over full scale, 0 is the loudest]; -inf in silence."""
    noise: float
    """Of what is no speech [dB over full scale]; NaN unknown."""
    snr: float
    """What a voice as loud as the last words would stand over that noise [dB]; NaN before any were heard."""
    speaking: bool = False
    clipped: bool = False
    """The microphone is overdriven."""


@dataclass(frozen=True, slots=True)
class State:
    """How the recogniser stands."""

    word: str
    """`starting`, `ready` (it hears nothing now; the sentence says why, if it should), `listening`, `muted` (the ears are open, and nothing
    comes in but silence; `listening` follows with the first sound), `too loud`, `failed` (it has ended)."""
    sentence: str = ""
    """Why, for the operator; empty where there is nothing to say."""


Event: TypeAlias = Partial | Result | Rejected | Level | State
Hear: TypeAlias = Callable[[Event], object]


class SpeechRecognizer(Protocol):
    """One way to understand speech. All methods return at once and are called in one thread; events come in any."""

    name: str
    """For the operator: what understands."""
    languages: tuple[str, ...]
    """ISO 639-1, of the grammars that it can be given."""

    def missing(self) -> str:
        """Why it cannot work here at all, in one sentence; empty when nothing is known against it."""
        ...

    def start(self, grammar: Grammar, hear: Hear) -> None:
        """Get ready to hear; `VoiceTrouble` when that is known to be impossible, `State("failed")` when it turns out so."""
        ...

    def listen(self, *, on: bool) -> None:
        """Open the ears, or close them: what was said by then is still judged."""
        ...

    def heed(self, commands: Collection[str] | None) -> None:
        """Count only these intents from now on; None for all but `Grammar.asked`. `Grammar.urgent` always count."""
        ...

    def stop(self) -> None:
        """Let go of everything; more than once does nothing."""
        ...
