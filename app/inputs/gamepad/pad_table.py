"""Places of sticks and buttons by SDL's table of gamepads: `a:b0,leftx:a0,lefttrigger:a2,dpup:h0.1,…`. No SDL in here."""

from __future__ import annotations

import re
from collections.abc import Sequence

__all__ = ["PadTable"]

RANGE = 32768.0
"""Of an axis on either side of its middle."""
PRESSED, RELEASED = 0.6, 0.4
"""A trigger counts as pressed beyond the first and as let go below the second, of its way."""
PART = re.compile(r"(\w+):([-+]?)(a|b|h)(\d+)(?:\.(\d+))?(~?)")
"""One entry of the table, as in `leftx:a0`, `lefty:a1~`, `b:b1`, `dpup:h0.1`."""
STICKS = {"leftx": 0, "lefty": 1, "rightx": 2, "righty": 3}
"""Axes of both sticks where SDL's table does not know the gamepad."""
FOUR = {"a": 0, "b": 1, "x": 2, "y": 3}
"""The four buttons there."""
TRIGGERS = ("lefttrigger", "righttrigger")


class PadTable:
    """The table's line for one gamepad that is plugged in; it remembers which trigger is pressed."""

    def __init__(self, mapping: str) -> None:
        """`mapping` is the line; empty for a gamepad that SDL does not know."""
        self._axes: dict[str, tuple[str, int]] = {}
        self._buttons: dict[str, int] = {}
        self._hats: dict[str, tuple[int, int]] = {}
        for name, sign, kind, number, bit, tilde in PART.findall(mapping):
            if kind == "a":
                self._axes[name] = sign + tilde, int(number)
            elif kind == "b":
                self._buttons[name] = int(number)
            else:
                self._hats[name] = int(number), int(bit or 0)
        for name, number in STICKS.items():
            self._axes.setdefault(name, ("", number))
        if not self._buttons:
            self._buttons = dict(FOUR)
        self.names = {number: name for name, number in self._buttons.items()}
        """What the numbers of its buttons are called."""
        self.east = self._buttons.get("b", FOUR["b"])
        """Number of the button on the right of the four."""
        self._pressed: set[str] = set()
        self._first: dict[int, int] = {}

    def share(self, name: str, raw: Sequence[int]) -> float:
        """A stick's axis from -1 to 1, turned round where the table says so."""
        way, index = self._axes[name]
        value = raw[index] / RANGE if index < len(raw) else 0.0
        return -value if way.startswith("-") or way.endswith("~") else value

    def triggers(self, raw: Sequence[int], buttons: Sequence[int]) -> tuple[float, float]:
        """How far the left and the right trigger are pressed, each 0 to 1."""
        left, right = (self._trigger(name, raw, buttons) for name in TRIGGERS)
        return left, right

    def _trigger(self, name: str, raw: Sequence[int], buttons: Sequence[int]) -> float:
        number = self._buttons.get(name)
        if number is not None:
            return float(number < len(buttons) and bool(buttons[number]))
        way, index = self._axes.get(name, ("", len(raw)))
        # SDL says 0, which is half of the way of a whole axis, until the trigger moves for the first time
        if index >= len(raw) or self._first.setdefault(index, raw[index]) == raw[index] == 0:
            return 0.0
        self._first[index] = 1
        value = raw[index] / RANGE
        if way[:1] in ("+", "-"):
            half = max(0.0, value if way[0] == "+" else -value)
            return 1.0 - half if way.endswith("~") else half
        return (1.0 - value if way == "~" else 1.0 + value) / 2

    def down(self, raw: Sequence[int], buttons: Sequence[int], hats: Sequence[int]) -> frozenset[str]:
        """Names of everything that is pressed, as in `a`, `dpup`, `lefttrigger`, `button 7`."""
        found = {self.names.get(index, f"button {index}") for index, down in enumerate(buttons) if down}
        found |= {name for name, (hat, bit) in self._hats.items() if hat < len(hats) and hats[hat] & bit}
        for name, share in zip(TRIGGERS, self.triggers(raw, buttons), strict=True):
            if share > (RELEASED if name in self._pressed else PRESSED):
                self._pressed.add(name)
                found.add(name)
            else:
                self._pressed.discard(name)
        return frozenset(found)
