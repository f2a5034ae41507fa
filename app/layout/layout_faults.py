"""Faults in a line of a layout, each as one sentence that says where it is and what is allowed."""

from __future__ import annotations

import re
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Any

import msgspec

from bridge.core.toml_files import MAX_FAULTS, shown
from bridge.core.toml_lines import line_of
from bridge.msgs import Msg

__all__ = [
    "FaultList",
    "LayoutError",
    "LayoutFault",
    "check_apart",
    "check_field",
    "check_room",
    "one_of",
    "place_in",
]


@dataclass(frozen=True)
class LayoutFault:
    """One thing that is wrong with a layout file."""

    sentence: str
    """What is wrong and what is allowed."""
    line: int = 0
    """Of the file, from 1 on; 0 for the whole file."""


class LayoutError(ValueError):
    """A layout that cannot be shown; the text says what is wrong and what is allowed, a line for each of the `faults`."""

    def __init__(self, sentence: str, faults: Sequence[LayoutFault] = ()) -> None:
        """`faults` are all that is wrong, in the order of the file; without any the sentence is the only one."""
        super().__init__(sentence)
        self.faults = tuple(faults) or (LayoutFault(sentence),)


class FaultList:
    """Everything that is wrong with one file."""

    def __init__(self, text: str) -> None:
        """`text` is the file's, in which the lines are found."""
        self._text = text
        self._faults: list[LayoutFault] = []
        self._keys: set[str] = set()

    def add(self, key: str, sentence: str, line: int = 0) -> None:
        """Note a fault of the key that is written as in `instrument[0].slot`; beyond 50 no more are noted."""
        self._keys.add(key)
        if len(self._faults) < MAX_FAULTS:
            self._faults.append(LayoutFault(sentence, line or (line_of(self._text, key) if key else 0)))

    def check(self, key: str, act: Callable[..., object], *args: object) -> bool:
        """Note the fault that a check finds; whether nothing is wrong with the key. One that has a fault is not checked again."""
        if key in self._keys:
            return False
        try:
            act(*args)
        except LayoutError as error:
            self.add(key, str(error))
            return False
        return True

    def check_key(self, table: str, key: str, act: Callable[..., object], *args: object) -> bool:
        """The same for a key of a table."""
        return self.check(f"{table}.{key}", act, *args)

    @property
    def error(self) -> LayoutError:
        """All of them, in the order of the file."""
        faults = sorted(self._faults, key=lambda one: one.line)
        return LayoutError("\n".join(one.sentence for one in faults), faults)

    def raise_any(self) -> None:
        """Raise LayoutError where there is any."""
        if self._faults:
            raise self.error


def place_in(where: str) -> str:
    """Tables counted as people count them: `view[0].panel[2]` is `, view 1, panel 3`."""
    return "".join(f", {name} {int(number) + 1}" for name, number in re.findall(r"(\w+)\[(\d+)\]", where))


def one_of(where: str, what: str, value: object, allowed: Iterable[str]) -> None:
    """`value` is one of those texts."""
    known = tuple(allowed)
    if not isinstance(value, str) or value not in known:
        raise LayoutError(f"{where}: {what} is one of {', '.join(known)}, not {shown(value)}.")


def check_room(where: str, what: str, slots: Sequence[str], room: Mapping[str, int]) -> None:
    """No place has more than it has room for."""
    for slot, most in room.items():
        if slots.count(slot) > most:
            raise LayoutError(f"{where} puts {slots.count(slot)} {what} into {slot}, where {most} fit.")


def check_field(where: str, kind: type[Msg], path: str) -> None:
    """A message of that type has a number there."""
    whole: Any = kind
    found = reduce(_member, path.split("."), whole)
    if found not in (float, int):
        raise LayoutError(f"{where}: {kind.MSGTYPE} has no number {shown(path)}.")


def _member(kind: Any, name: str) -> Any:
    """The type of a field of a message type; None when there is none. Letters of a vector, as in `xy`, are its length that way."""
    if not (isinstance(kind, type) and issubclass(kind, msgspec.Struct)):
        return None
    if len(name) > 1 and set(name) <= set("xyz"):
        return float if all(_member(kind, letter) is float for letter in name) else None
    return typing.get_type_hints(kind).get(name)


def check_apart(where: str, sticks: Iterable[tuple[str, str, Sequence[str]]]) -> None:
    """Controls, each with its slot, name and what it says: of those on the glass at once no two say the same.

    Of two in one slot one is on the glass, and a switch between them tells them by their names.
    """
    owners: dict[str, str] = {}
    names: set[tuple[str, str]] = set()
    for slot, name, parts in sticks:
        if (slot, name) in names:
            raise LayoutError(
                f"{where} has two controls called {shown(name)} in {slot}; each has a title of its own."
            )
        names.add((slot, name))
        for part in parts:
            if parts.count(part) > 1 or owners.setdefault(part, slot) != slot:
                raise LayoutError(f"{where} has two controls for {part}; each must have its own.")
