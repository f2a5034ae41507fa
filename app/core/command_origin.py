"""The origin of a command: its method, how sure it was, and when the hand or the voice began and ended.

with origins.during(Origin("voice", confidence=0.9, began=12.1, ended=12.8, decided=12.9, said="go home")):
    session.command("home")        # takes the origin along by itself

Everything in the UI thread.
"""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from widgets.core.language import mark, tr

__all__ = ["ITSELF", "NOBODY", "Origin", "Origins", "gave_stop", "origins"]

ITSELF = ""
"""The method of what nobody asked for just now: the app did it by itself, as taking control that is free."""


@dataclass(frozen=True, slots=True)
class Origin:
    """Who asked, and how. Instants are of our clock [s, monotonic]; NaN for what is not known."""

    method: str = "button"
    """One of `app.intents.intents.METHODS`, or `ITSELF`."""
    confidence: float = math.nan
    """How sure the method was, 0 to 1; NaN where it does not say, as for a button."""
    began: float = math.nan
    """When gesture, word, press or touch began."""
    ended: float = math.nan
    """When it ended; NaN for what acts before its end, as a shake that means STOP."""
    decided: float = math.nan
    """When the app knew what was meant."""
    said: str = ""
    """What was understood, in words; empty for a button."""
    noise: float = math.nan
    """How loud it was round about then [dB]."""
    intent: str = ""
    """Key in `app.intents.intents.INTENTS`; empty where a control was used that has none."""


GUESSED = {"voice": mark("Your voice"), "shake": mark("A shake")}
"""Methods that guess what a hand or a voice meant, and so may be wrong."""


def gave_stop(origin: Origin) -> str:
    """What gave STOP, as in `Your voice gave STOP: “stop”, 99 % sure.`; empty for a hand on a button, who knows it."""
    if origin.method not in GUESSED:
        return ""
    said = f"“{origin.said}”" if origin.said else ""
    sure = (
        ""
        if math.isnan(origin.confidence)
        else tr("{percent:.0f} % sure").format(percent=origin.confidence * 100)
    )
    about = ", ".join(filter(None, (said, sure)))
    method = tr(GUESSED[origin.method])
    if not about:
        return tr("{method} gave STOP.").format(method=method)
    return tr("{method} gave STOP: {about}.").format(method=method, about=about)


LASTS = 1.0
"""What is done so long after a finger or a key was lifted is not its doing any more [s]."""
NOBODY = Origin(ITSELF)
"""The app by itself."""


class Origins:
    """Which origin whatever is done now has. Without a word about it that is who touched the glass just now, else nobody."""

    def __init__(self) -> None:
        self._during: list[Origin] = []
        self._touch: Origin | None = None
        """Of the newest finger, or the key that was typed; None where all were lifted long ago."""
        self._down = 0
        """Fingers on the glass."""

    def current(self) -> Origin:
        """The origin of what is done now."""
        return self._during[-1] if self._during else self._touch or NOBODY

    @contextlib.contextmanager
    def during(self, origin: Origin) -> Iterator[None]:
        """What is done within comes from there."""
        self._during.append(origin)
        try:
            yield
        finally:
            self._during.pop()

    def touched(self, now: float) -> None:
        """A finger came down at `now` [s]: what is done next began then."""
        self._down += 1
        self._touch = Origin(began=now)

    def lifted(self, now: float) -> None:
        """A finger was lifted."""
        self._down = max(0, self._down - 1)
        if self._touch is not None:
            self._touch = replace(self._touch, ended=now)

    def typed(self, now: float) -> None:
        """A key was pressed that means something only to a field or a button on the glass."""
        self._touch = Origin("keyboard", began=now, ended=now)

    def update(self, now: float) -> None:
        """With each heartbeat: who touched the glass long ago does nothing any more."""
        if self._touch is not None and not self._down and now - self._touch.ended > LASTS:
            self._touch = None

    def forget(self) -> None:
        """The glass is taken away: no finger is on it."""
        self._touch, self._down = None, 0


origins = Origins()
"""Of this process: one app runs in it."""
