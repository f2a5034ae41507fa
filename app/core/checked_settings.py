"""The one way to look at what was kept: whatever a settings file holds is either what it should be, or said and reset to default.

    kept = Kept(settings.get("talk"), "talking")
    on, rate = kept.flag("on", usual=False), kept.number("rate", 0.5, 2.0, usual=1.0)
    kept.sentence       # "In the settings of talking rate is from 0.5 to 2, not 'fast': reset to default."

JSON may hold anything in any place: lists where names are looked up, whole numbers that no float can hold, NaN.
"""

from __future__ import annotations

import reprlib
from collections.abc import Container, Mapping
from typing import Any, TypeGuard

from widgets.core.language import tr

__all__ = ["CheckedSettings", "known", "number", "shown"]

LETTERS = 40
"""So much of a value is shown."""
_BRIEF = reprlib.Repr()
"""Writes no more than can be shown: a few letters of YAML may stand for gigabytes of lists."""
_BRIEF.maxlevel = 3
_BRIEF.maxlist = _BRIEF.maxtuple = _BRIEF.maxset = _BRIEF.maxdict = _BRIEF.maxdeque = LETTERS
_BRIEF.maxstring = _BRIEF.maxlong = _BRIEF.maxother = 2 * LETTERS


def number(value: object, low: float, high: float) -> float | None:
    """It as a float where it is a number from `low` to `high`, else None: for true and false, NaN, and everything else."""
    fits = isinstance(value, int | float) and not isinstance(value, bool) and low <= value <= high
    return float(value) if fits else None  # type: ignore[arg-type]


def known(value: object, allowed: Container[str]) -> TypeGuard[str]:
    """It is a text, and one of those."""
    return isinstance(value, str) and value in allowed


def shown(value: object) -> str:
    """As it is shown in a sentence: not at any length."""
    text = _BRIEF.repr(value)
    return text if len(text) <= LETTERS else f"{text[: LETTERS - 1]}…"


class CheckedSettings:
    """A table of settings that is read value by value; what is not there is as usual, and no mistake."""

    def __init__(self, value: object, about: str) -> None:
        """`value` is what was kept, None for nothing; `about` what the settings are of, in words that are marked."""
        self._about = about
        self._wrong: list[str] = []
        self.values: Mapping[str, Any] = value if isinstance(value, Mapping) else {}
        """What was kept, unchecked."""
        if value is not None and not isinstance(value, Mapping):
            self._wrong.append(tr("the stored value is no table but {value}").format(value=shown(value)))

    @property
    def sentence(self) -> str:
        """What was no good, in one sentence; empty when all is well."""
        if not self._wrong:
            return ""
        return tr("In the settings of {about} {wrong}: reset to default.").format(
            about=tr(self._about), wrong=", ".join(self._wrong)
        )

    def flag(self, name: str, *, usual: bool) -> bool:
        """True or false."""
        value = self.values.get(name, usual)
        if isinstance(value, bool):
            return value
        self.mistaken(name, tr("true or false"))
        return usual

    def number(self, name: str, low: float, high: float, usual: float) -> float:
        """A number from `low` to `high`."""
        found = number(self.values.get(name, usual), low, high)
        if found is None:
            self.mistaken(name, tr("from {low:g} to {high:g}").format(low=low, high=high))
        return usual if found is None else found

    def word(self, name: str, allowed: Container[str], usual: str) -> str:
        """One of those texts."""
        value = self.values.get(name, usual)
        if known(value, allowed):
            return value
        self.mistaken(name, tr("one of the known"))
        return usual

    def mistaken(self, name: str, allowed: str) -> None:
        """Note that the value of that name is not what is `allowed`."""
        value = shown(self.values.get(name))
        self._wrong.append(
            tr("{name} is {allowed}, not {value}").format(name=name, allowed=allowed, value=value)
        )
