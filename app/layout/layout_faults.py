"""Faults in a line of a layout, each as one sentence that says where it is and what is allowed."""

from __future__ import annotations

import typing
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from typing import Any

import msgspec

from bridge.core.toml_files import shown
from bridge.msgs import Msg

__all__ = [
    "LayoutError",
    "check_apart",
    "check_field",
    "check_room",
    "one_of",
]


class LayoutError(ValueError):
    """A layout that cannot be shown; the text is one sentence that says what is wrong and what is allowed."""


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
