"""Layout files: which instruments sit in which place of the drive screen, and what is wrong with one in a sentence."""

from __future__ import annotations

import tomllib
import typing
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import Any

import msgspec

from bridge.msgs import Msg
from bridge.topics import TOPICS, topic

__all__ = ["FOLDER", "SLOTS", "Instrument", "Layout", "LayoutError", "load", "names", "parse"]

FOLDER = Path(__file__).parent / "layouts"
SLOTS = {"top_left": 1, "top": 1, "top_right": 1, "readouts": 4, "senses": 3}
"""Place on the drive screen to the number of instruments that fit."""
_TEXTS = {"slot", "widget", "topic", "field", "title", "unit"}
_NUMBERS = {"factor", "digits"}


class LayoutError(ValueError):
    """A layout that cannot be shown; the text is one sentence that says what is wrong and what is allowed."""


@dataclass(frozen=True)
class Instrument:
    """One instrument of a layout."""

    slot: str
    """Key in `SLOTS`."""
    widget: str
    """Name in the widget catalogue."""
    topic: str
    field: str = ""
    """Path of the number that a Readout shows, as in `twist.twist.linear.x`; empty for other widgets."""
    title: str = ""
    unit: str = ""
    factor: float = 1.0
    """What the number is multiplied by to be in `unit`."""
    digits: int = 1
    """Figures behind the point."""
    also: tuple[str, ...] = ()
    """Further topics of the same type that it shows with the first."""

    @property
    def topics(self) -> tuple[str, ...]:
        """All topics that it shows."""
        return (self.topic, *self.also)


@dataclass(frozen=True)
class Layout:
    """A drive screen."""

    name: str
    title: str
    instruments: tuple[Instrument, ...]


def names(folder: Path = FOLDER) -> list[str]:
    """Names of the layouts there are."""
    return sorted(path.stem for path in folder.glob("*.toml"))


def load(name: str, widgets: Iterable[str], folder: Path = FOLDER) -> Layout:
    """The layout of that name; `widgets` are the names of the catalogue. LayoutError with a sentence."""
    if name not in names(folder):
        raise LayoutError(f"There is no layout {name!r}; there are: {', '.join(names(folder))}.")
    return parse(name, (folder / f"{name}.toml").read_text(encoding="utf-8"), widgets)


def parse(name: str, text: str, widgets: Iterable[str]) -> Layout:
    """The layout in TOML text; LayoutError with a sentence."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise LayoutError(f"Layout {name} is no TOML: {error}.") from error
    entries = data.get("instrument", [])
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise LayoutError(f"Layout {name} lists its instruments as [[instrument]] tables.")
    known = frozenset(widgets)
    instruments = tuple(
        _instrument(f"Layout {name}, instrument {i}", e, known) for i, e in enumerate(entries, 1)
    )
    for slot, room in SLOTS.items():
        count = sum(one.slot == slot for one in instruments)
        if count > room:
            raise LayoutError(f"Layout {name} puts {count} instruments into {slot}, where {room} fit.")
    return Layout(name, str(data.get("title", name)), instruments)


def _instrument(where: str, entry: Mapping[str, Any], widgets: frozenset[str]) -> Instrument:
    _check_keys(where, entry)
    _one_of(where, "slot", entry.get("slot"), SLOTS)
    _one_of(where, "widget", entry.get("widget"), sorted(widgets))
    _one_of(where, "topic", entry.get("topic"), [one.name for one in TOPICS if one.to == "handheld"])
    if entry["widget"] == "Readout":
        _check_field(where, topic(entry["topic"]).type, entry.get("field", ""))
    also = entry.get("also", [])
    if not isinstance(also, list):
        raise LayoutError(f"{where}: also is a list of topics, not {also!r}.")
    same = [one.name for one in TOPICS if one.type is topic(entry["topic"]).type and one.to == "handheld"]
    for name in also:
        _one_of(where, "also", name, same)
    return Instrument(**{**entry, "also": tuple(also)})


def _check_keys(where: str, entry: Mapping[str, Any]) -> None:
    for key, value in entry.items():
        _one_of(where, "key", key, sorted(_TEXTS | _NUMBERS | {"also"}))
        if key in _TEXTS and not isinstance(value, str):
            raise LayoutError(f"{where}: {key} is a text, not {value!r}.")
        if key in _NUMBERS and (isinstance(value, bool) or not isinstance(value, int | float)):
            raise LayoutError(f"{where}: {key} is a number, not {value!r}.")


def _one_of(where: str, what: str, value: object, allowed: Iterable[str]) -> None:
    if value not in allowed:
        raise LayoutError(f"{where}: {what} is one of {', '.join(allowed)}, not {value!r}.")


def _check_field(where: str, kind: type[Msg], path: str) -> None:
    found = reduce(_member, path.split("."), kind)
    if found not in (float, int):
        raise LayoutError(f"{where}: {kind.MSGTYPE} has no number {path!r}.")


def _member(kind: Any, name: str) -> Any:
    """The type of a field of a message type; None when there is none."""
    if not (isinstance(kind, type) and issubclass(kind, msgspec.Struct)):
        return None
    return typing.get_type_hints(kind).get(name)
