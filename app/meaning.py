"""What a key or a button of a gamepad means: one of the app's intents, pausing or going on by turns, or something that is on while it is held.

meanings.press("go_home", press)        # asks the one way in, app.intents
meanings.held["talk"].append(listen)    # listen(True) while the key is held, listen(False) when it is not
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.intents import INTENTS, Heard
from app.press import Press

__all__ = ["HOLDS", "MEANINGS", "Meanings", "meaning_icon", "meaning_words"]

METHOD_OF = {"key": "keyboard", "pad": "gamepad"}
HOLDS = {"talk": ("Talk while held", "mic"), "tilt": ("Tilt drives while held", "screen_rotation_alt")}
"""What is on for as long as a key or a button is held, with its words and its icon."""
TURNS = "pause_resume"
MEANINGS: dict[str, tuple[str, str]] = {
    **{name: (intent.words, intent.icon) for name, intent in INTENTS.items()},
    TURNS: ("Pause or resume", "pause"),
    **{f"hold.{name}": words for name, words in HOLDS.items()},
}
"""Everything that a key or a button can mean, with its words and its icon."""


def meaning_words(meaning: str) -> str:
    """In words; those of nothing for what there is not."""
    return MEANINGS.get(meaning, ("Nothing", ""))[0]


def meaning_icon(meaning: str) -> str:
    """Name of its icon."""
    return MEANINGS.get(meaning, ("", "block"))[1]


class Meanings:
    """Does what a press means. Everything in the UI thread."""

    def __init__(self, app: Any, now: Callable[[], float]) -> None:
        """`app` is asked for its `intents` and its `session`."""
        self._app, self._now = app, now
        self.held: dict[str, list[Callable[[bool], object]]] = {name: [] for name in HOLDS}
        """Who is told when one of `HOLDS` begins and ends."""
        self._holding: dict[str, set[tuple[str, int, str]]] = {name: set() for name in HOLDS}

    def press(self, meaning: str, press: Press) -> bool:
        """What means `meaning` went down; False where nobody does anything with it."""
        kind, _, name = meaning.partition(".")
        if kind == "hold" and name in HOLDS:
            return self._hold(name, press)
        intent = self._turn() if meaning == TURNS else meaning
        intents = getattr(self._app, "intents", None)
        if intent not in INTENTS or intents is None or (intent in ("yes", "no") and not intents.asking):
            return False
        words = f"{press.name} of {press.device}" if press.device else press.name
        method = METHOD_OF[press.source]
        intents.take(Heard(intent, method, began=press.at, ended=self._now(), said=words))
        return True

    def release(self, meaning: str, press: Press) -> None:
        """It went up."""
        kind, _, name = meaning.partition(".")
        if kind == "hold" and press.same in self._holding.get(name, ()):
            self._holding[name].discard(press.same)
            if not self._holding[name]:
                self._tell(name, on=False)

    def _hold(self, name: str, press: Press) -> bool:
        if not self.held[name]:
            return False
        self._holding[name].add(press.same)
        if len(self._holding[name]) == 1:
            self._tell(name, on=True)
        return True

    def _tell(self, name: str, *, on: bool) -> None:
        for listener in list(self.held[name]):
            listener(on)

    def _turn(self) -> str:
        session = self._app.session
        status = session.feeds.latest("/task/status") if session is not None else None
        return "resume" if status is not None and status.state == "PAUSED" else "pause"
