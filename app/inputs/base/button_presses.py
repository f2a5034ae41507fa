"""Presses of keys and of a gamepad's buttons: each is told once, however often the system repeats it, and STOP comes first.

presses = Presses(is_stop, stop, now)
presses.takers.insert(0, mine)      # asked before whoever stands behind it; never before STOP
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Protocol

__all__ = ["Press", "Presses", "Taker"]


@dataclass(frozen=True, slots=True)
class Press:
    """A key or a button that went down."""

    source: str
    """`key` or `pad`."""
    code: int
    """Kivy's key code, or its number of the button; -1 for a trigger or a cross, which have none."""
    name: str
    """What it is called, as in `tab`, `spacebar`, `w`; of a gamepad's as in `a`, `dpup`, `button 7`."""
    at: float
    """When [s, monotonic]."""
    device: str = ""
    """Name of the gamepad; empty for a keyboard."""
    number: int = 0
    """SDL's number of the gamepad; 0 for a keyboard."""
    scancode: int = 0
    """Where the key is, whatever is printed on it; 0 where that is not known."""
    modifiers: frozenset[str] = frozenset()
    """Keys held with it, of `shift`, `ctrl`, `alt`, `meta`."""
    text: str = ""
    """What the key types, where the system tells."""

    @property
    def same(self) -> tuple[str, int, str]:
        """What is one and the same key or button, pressed whenever."""
        return self.source, self.number, self.name


class Taker(Protocol):
    """Whoever does something with presses."""

    def pressed(self, press: Press) -> bool:
        """It went down, once for each time. True takes it: nobody behind hears of it."""

    def released(self, press: Press) -> None:
        """What was taken went up, or the window lost its focus, or the gamepad was pulled out; `press` is the one that was taken."""


class Presses:
    """What is down, and who has it. Everything in the UI thread."""

    def __init__(self, is_stop: Callable[[Press], bool], stop: Callable[[Press], object]) -> None:
        """`is_stop` tells of a press whether it means STOP now, `stop` does it."""
        self._is_stop, self._stop = is_stop, stop
        self.takers: list[Taker] = []
        """Those who are asked, one after the other, until one of them takes it."""
        self._down: dict[tuple[str, int, str], tuple[Press, Taker | None, bool]] = {}
        """What is down, who took it, and whether it means anything here."""

    @property
    def down(self) -> list[Press]:
        """What is down now, as it was told first."""
        return [press for press, _, _ in self._down.values()]

    def press(self, press: Press) -> bool:
        """It is down, for the first time or still. True when it means something here."""
        if press.same in self._down:
            return self._down[press.same][2]
        if self._is_stop(press):
            self._down[press.same] = press, None, True
            self._stop(press)
            return True
        taker = next((taker for taker in list(self.takers) if taker.pressed(press)), None)
        self._down[press.same] = press, taker, taker is not None
        return taker is not None

    def release(self, source: str, number: int, name: str) -> None:
        """It is up; nothing where it was not down."""
        press, taker, _ = self._down.pop((source, number, name), (None, None, False))
        if press is not None and taker is not None:
            taker.released(press)

    def buttons(self, number: int, device: str, down: Collection[str], now: float) -> None:
        """What is down on one gamepad, by the names: what is new is a press, what is missing is a release."""
        for _, at, name in [same for same in self._down if same[:2] == ("pad", number)]:
            if name not in down:
                self.release("pad", at, name)
        for name in sorted(down):
            self.press(Press("pad", -1, name, now, device, number))

    def forget(self, source: str = "", number: int | None = None) -> None:
        """All that is down, of one source or of one gamepad where that is given, counts as up: its end would not be told."""
        for same in list(self._down):
            if source in ("", same[0]) and number in (None, same[1]):
                self.release(*same)
