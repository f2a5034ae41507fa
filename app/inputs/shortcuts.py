"""Keys and buttons that mean something: the last who is asked about a press, after switches and after what drives."""

from __future__ import annotations

from collections.abc import Callable

from app.inputs.base.button_presses import Press
from app.inputs.binding_actions import BindingActions
from app.inputs.gamepad.pad_map import Profile
from app.inputs.keys.key_table import FIXED, KeyTable

__all__ = ["Shortcuts"]

WITH = frozenset({"ctrl", "alt", "meta"})
"""Held with a key they make it the system's or somebody else's."""
SHIFTED = {"/": "?"}
"""What Shift makes of a key on most keyboards; the window tells only the key."""


class Shortcuts:
    """Takes what has a meaning, and does it."""

    def __init__(
        self,
        meanings: BindingActions,
        keys: Callable[[], KeyTable],
        profile: Callable[[str], Profile],
        typing: Callable[[], bool],
        pads_on: Callable[[], bool] = lambda: True,
    ) -> None:
        """`profile` gives that of the gamepad of that name, `typing` tells that a field takes what is typed."""
        self._meanings, self._keys, self._profile = meanings, keys, profile
        self._typing, self._pads_on = typing, pads_on
        self._taken: dict[tuple[str, int, str], str] = {}

    def meaning(self, press: Press) -> str:
        """What it means now; empty for nothing."""
        if press.source == "pad":
            return self._profile(press.device).meaning(press.name) if self._pads_on() else ""
        table = self._keys()
        if (
            not table.on or press.modifiers & WITH or press.name in FIXED
        ):  # Android's Back is called escape, too
            return ""
        if self._typing() and not (press.name.startswith("f") and press.name[1:].isdigit()):
            return ""
        shifted = SHIFTED.get(press.name) if "shift" in press.modifiers else None
        return next(
            (found for key in (press.text, shifted, press.name) if key and (found := table.meaning(key))), ""
        )

    def pressed(self, press: Press) -> bool:
        """Do what it means."""
        meaning = self.meaning(press)
        if not meaning or not self._meanings.press(meaning, press):
            return False
        self._taken[press.same] = meaning
        return True

    def released(self, press: Press) -> None:
        """What is on while it is held ends."""
        self._meanings.release(self._taken.pop(press.same, ""), press)
