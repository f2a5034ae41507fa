"""Prompts for a recognised intent that waits, over every screen of a robot; and a sentence on the outcome of each intent."""

from __future__ import annotations

import math
from typing import Any

from app.device.vibration import REFUSED, STOPS, UNDERSTOOD, vibrate
from app.intents.intents import CANCEL_TIME, CONFIRM_TIME, INTENTS, PRESSED, Heard, Intents, Pending, Verdict
from app.intents.method_permits import LOOKS
from app.screens.parts.method_signs import METHOD_SIGNS
from app.screens.shell.notices import Notices
from widgets import IntentCard
from widgets.core.language import tr

__all__ = ["IntentPrompts", "heard_words"]

ABOUT = "intent"
"""What the sentences tell of."""
EYES_FREE_METHODS = ("voice", "shake", "switches")
"""Methods whose user may not look at the glass."""
FELT = {
    "acted": UNDERSTOOD,
    "waits": UNDERSTOOD,
    "asks": UNDERSTOOD,
    "not allowed": REFUSED,
    "not now": REFUSED,
    "lapsed": REFUSED,
}
"""What their hand feels of what came of it."""


def heard_words(heard: Heard) -> str:
    """Who understood what, and how surely, as in `Voice, “go home”: 82 % sure.`"""
    name = tr(METHOD_SIGNS[heard.method][1]) if heard.method in METHOD_SIGNS else heard.method.capitalize()
    what = f", “{heard.said}”" if heard.said else ""
    guess = heard.method not in PRESSED and not math.isnan(heard.confidence)
    sure = tr(": {confidence:.0f} % sure.").format(confidence=heard.confidence * 100) if guess else "."
    return f"{name}{what}{sure}"


class IntentPrompts:
    """The card of one robot's frame."""

    def __init__(self, intents: Intents, notices: Notices, say: Any) -> None:
        """`say` is as `Shell.say`."""
        self._intents, self._notices, self._say = intents, notices, say
        self._shown: Pending | None = None
        self._refused = ""
        """The method whose refusal was said last; empty where a success was."""
        self.tight = False
        """There is room for the card alone: what would be said beside it is said on it."""
        self.card = IntentCard()
        self.card.bind(on_command=lambda _, name: intents.answer(name == "yes"))
        intents.on_taken.append(self._told)

    def close(self) -> None:
        """Tell of nothing any more."""
        if self._told in self._intents.on_taken:
            self._intents.on_taken.remove(self._told)

    def update(self, now: float) -> None:
        """Bring up to date what waits, and for how long; with each heartbeat, `now` is our clock [s]."""
        pending = self._intents.pending
        if pending is not self._shown:
            self._shown = pending
            if pending is not None:
                self._notices.hush()
                self._show(pending)
            self._notices.keep(self.card, shown=pending is not None, first=True)
        if pending is not None:
            self.card.count(pending.until - now, CONFIRM_TIME if pending.question else CANCEL_TIME)

    def _show(self, pending: Pending) -> None:
        heard = pending.heard
        who = METHOD_SIGNS[heard.method][0] if heard.method in METHOD_SIGNS else "touch_app"
        words = self._intents.words(heard.intent)
        said = heard_words(heard) + (tr(" Yes or no, by any method.") if pending.question else "")
        self.card.ask(words=words, who=who, heard=said, question=pending.question)

    def _told(self, heard: Heard, verdict: Verdict) -> None:
        """What is done or cancelled is said; what waits has its card."""
        if heard.method in EYES_FREE_METHODS and verdict.what in FELT:
            # a new pattern ends the one before: that of a STOP that was shaken must not be cut short
            stops = heard.intent == "stop" and verdict.what == "acted"
            vibrate(STOPS if stops else FELT[verdict.what])
        if not verdict.done or not verdict.sentence or verdict.what in ("cancelled", "practised"):
            return  # its card goes, and whoever said no is told so; the study's own card says what was understood
        done = verdict.what == "acted"
        if done and (heard.method in PRESSED or heard.intent in LOOKS):
            if heard.method == self._refused:  # what was refused before is not about this one
                self._refused = ""
                self._notices.unsay(ABOUT)
            return  # whoever pressed it sees what it did
        self._refused = "" if done else heard.method
        lead = f"{heard_words(heard)} " if verdict.what == "acted" else ""
        if verdict.what == "not now":
            lead = f"{INTENTS[heard.intent].words}: "
        if self.tight and self.card.parent is not None:
            self.card.heard = lead + verdict.sentence
        else:
            self._say(lead + verdict.sentence, "info" if done else "warn", about=ABOUT)
