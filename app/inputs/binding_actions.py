"""Actions of keys and gamepad buttons: an intent, pause and resume by turns, or something that lasts while it is held.

meanings.press("go_home", press)        # asks the one way in, app.intents
meanings.held["talk"].append(listen)    # listen(True) while the key is held, listen(False) when it is not
"""

from __future__ import annotations

from collections.abc import Callable

from app.inputs.base.button_presses import Press
from app.inputs.base.method_app import MethodApp
from app.inputs.keys.held_key import MAX_HOLD, HeldKey
from app.intents.intents import INTENTS, Heard
from widgets.core.language import mark, tr

__all__ = ["HOLDS", "MEANINGS", "BindingActions", "meaning_icon", "meaning_words"]

METHOD_OF = {"key": "keyboard", "pad": "gamepad"}
HOLDS = {
    "talk": (mark("Talk while held"), "mic"),
    "tilt": (mark("Tilt drives while held"), "screen_rotation_alt"),
}
"""What is on for as long as a key or a button is held, with its words and its icon."""
TURNS = "pause_resume"
MEANINGS: dict[str, tuple[str, str]] = {
    **{name: (intent.words, intent.icon) for name, intent in INTENTS.items()},
    TURNS: (mark("Pause or resume"), "pause"),
    **{f"hold.{name}": words for name, words in HOLDS.items()},
}
"""Everything that a key or a button can mean, with its words and its icon."""


def meaning_words(meaning: str) -> str:
    """In words; those of nothing for what there is not."""
    return tr(MEANINGS.get(meaning, (mark("Nothing"), ""))[0])


def meaning_icon(meaning: str) -> str:
    """Name of its icon."""
    return MEANINGS.get(meaning, ("", "block"))[1]


class BindingActions:
    """Does what a press means; `update` belongs to the heartbeat. Everything in the UI thread.

    What is held ends with its key or button, and where that is never told as keys that drive end (`app.inputs.keys.held_key`), or with
    the gamepad that says nothing any more; then it must be let go before it holds again.
    """

    def __init__(
        self,
        app: MethodApp,
        now: Callable[[], float],
        *,
        is_down: Callable[[int], bool] | None = None,
        silent: Callable[[int], bool] = lambda _: False,
        on_lost: Callable[[str, Press], object] = lambda *_: None,
    ) -> None:
        """`app` is asked for its `intents` and its `session`.

        `is_down` tells whether the key at a place of the keyboard is down, where somebody knows; `silent`, whether the gamepad
        of that number says nothing any more; `on_lost` hears why what was held ended.
        """
        self._app, self._now = app, now
        self._is_down, self._silent, self._on_lost = is_down, silent, on_lost
        self.held: dict[str, list[Callable[[bool], object]]] = {name: [] for name in HOLDS}
        """Who is told when one of `HOLDS` begins and ends."""
        self._holding: dict[str, dict[tuple[str, int, str], HeldKey]] = {name: {} for name in HOLDS}
        self._newest = ""
        """The key that went down last, which alone is repeated."""

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
        intents.submit(Heard(intent, method, began=press.at, ended=self._now(), said=words))
        return True

    def release(self, meaning: str, press: Press) -> None:
        """It went up."""
        kind, _, name = meaning.partition(".")
        if kind == "hold":
            self._let_go(name, press)

    def repeated(self, key: str) -> None:
        """The system says, first or again, that the key of this name is down."""
        self._newest = key
        for holding in self._holding.values():
            for held in holding.values():
                if held.press.source == "key" and held.press.name == key:
                    held.repeated(self._now())

    def holds(self, source: str) -> bool:
        """Something of `key` or `pad` holds something."""
        return any(
            held.press.source == source for holding in self._holding.values() for held in holding.values()
        )

    def lose(self, source: str) -> None:
        """Nothing of `key` or `pad` holds anything until it is let go and pressed anew."""
        for name, holding in self._holding.items():
            for held in [held for held in holding.values() if held.press.source == source]:
                self._let_go(name, held.press)

    def update(self) -> None:
        """With each heartbeat: whatever is held is looked at, whether a hand still holds it."""
        for name, holding in self._holding.items():
            for held in list(holding.values()):
                why = self._ended(held)
                if why is not None:
                    self._let_go(name, held.press)
                if why:
                    self._on_lost(
                        tr("{why}: let it go, and press it again for: {holds}.").format(
                            why=why, holds=tr(HOLDS[name][0])
                        ),
                        held.press,
                    )

    def _ended(self, held: HeldKey) -> str | None:
        """Why nobody holds it any more; empty where it was simply let go, None where it is held."""
        press, now = held.press, self._now()
        if held.too_long(now):
            return tr("{name} is held for {max_hold:.0f} s").format(
                name=press.name.upper(), max_hold=MAX_HOLD
            )
        if press.source == "pad":
            return (
                tr("{device} is silent").format(device=press.device or tr("The gamepad"))
                if self._silent(press.number)
                else None
            )
        away = press.name == self._newest and held.silent(now)
        return "" if held.up(self._is_down) or away else None

    def _hold(self, name: str, press: Press) -> bool:
        if not self.held[name]:
            return False
        self._holding[name][press.same] = HeldKey(press, press.at, press.at)
        if len(self._holding[name]) == 1:
            self._tell(name, on=True)
        return True

    def _let_go(self, name: str, press: Press) -> None:
        holding = self._holding.get(name, {})
        if holding.pop(press.same, None) is not None and not holding:
            self._tell(name, on=False)

    def _tell(self, name: str, *, on: bool) -> None:
        for listener in list(self.held[name]):
            listener(on)

    def _turn(self) -> str:
        session = self._app.session
        status = session.feeds.latest("/task/status") if session is not None else None
        return "resume" if status is not None and status.state == "PAUSED" else "pause"
