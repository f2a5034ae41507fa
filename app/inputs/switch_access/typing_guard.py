"""A guard for keys that are switches while somebody types: for as long as they do, a switch types as well."""

from __future__ import annotations

import math
from collections.abc import Iterable

from app.inputs.base.button_presses import Press

__all__ = ["TYPING_TIME", "TypingGuard", "types_letters"]

SILENT_KEYS = frozenset(
    ("shift", "rshift", "lctrl", "rctrl", "alt", "alt-gr", "super", "capslock", "numlock", "escape")
)
"""Keys that type nothing."""
TYPING_TIME = 10.0
"""Who typed, or touched the window, so shortly ago [s] still types: longer, and nobody could wake the scan beside a field."""


def types_letters(press: Press) -> bool:
    """It is a key that types something into a field."""
    return press.source == "key" and press.name not in SILENT_KEYS


class TypingGuard:
    """When somebody typed last, and which switches are down and type: only STOP comes of those."""

    def __init__(self) -> None:
        self._typed = -math.inf
        self._down: set[tuple[str, int, str]] = set()

    def note(self, now: float) -> None:
        """Somebody types, or touches the window [s]."""
        self._typed = now

    def takes(self, press: Press) -> bool:
        """A field has the focus: whether this switch types into it."""
        types = press.source == "key" and press.at - self._typed < TYPING_TIME
        if types:
            self._down.add(press.same)
        return types

    def lifted(self, down: Iterable[Press]) -> list[tuple[str, int, str]]:
        """Switches that typed and are not among those that are `down`: who takes no press is not told of its end."""
        if not self._down:
            return []
        up = self._down - {press.same for press in down}
        self._down -= up
        return list(up)

    def clear(self) -> None:
        """No switch types any more."""
        self._down.clear()
