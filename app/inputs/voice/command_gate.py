"""A gate for spoken commands: fewer count while the app itself talks, and while something asks."""

from __future__ import annotations

import math
from collections.abc import Collection

from app.inputs.base.method_app import MethodApp
from app.inputs.voice.interfaces.speech_recognizer import Result
from widgets.core.language import mark, tr

__all__ = ["DEAF", "EARLIER", "CommandGate"]

ECHO_TIME = 0.3
"""What was heard up to so long after the app itself spoke was its own voice [s]."""
ANSWERS = frozenset({"yes", "no", "pause"})
"""What counts while something waits for a yes; STOP always does."""
DEAF = mark("The app itself was speaking.")
EARLIER = mark("That answer came before the question.")


class CommandGate:
    """Of one app. STOP passes it always. Everything in the UI thread."""

    def __init__(self, app: MethodApp) -> None:
        """`app` is asked for its `intents` and its `talk`."""
        self._app = app
        self._asked_since = math.nan
        """Since when a question is open [s]; NaN for none."""

    def update(self, now: float) -> None:
        """Each tick: note since when something asks."""
        asking = self._app.intents.asking
        if asking != (not math.isnan(self._asked_since)):
            self._asked_since = now if asking else math.nan

    def counting(self, commands: Collection[str]) -> frozenset[str] | None:
        """Those of `commands` that count now; None for all that need no question."""
        if self._talked()[0]:
            return frozenset()
        if self._app.intents.pending is not None:
            return ANSWERS
        return frozenset(commands) if self._app.intents.asking else None

    def why_not(self, result: Result) -> str:
        """Why `result` does not count, as a sentence; empty where it does."""
        speaks, spoke = self._talked()
        if speaks or result.began < spoke + ECHO_TIME:
            return tr(DEAF)
        if result.command in ("yes", "no") and result.began < self._asked_since:
            return tr(EARLIER)
        return ""

    def _talked(self) -> tuple[bool, float]:
        """Whether the app itself speaks, and when it did last [s]; one that cannot talk never did."""
        talk = getattr(self._app, "talk", None)
        return (talk.speaking, talk.spoke) if talk is not None else (False, -math.inf)
