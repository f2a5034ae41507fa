"""Line numbers of the keys of a TOML text, which the parser of the standard library does not give."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from typing import Any, NamedTuple, TypeAlias

__all__ = ["Keys", "Statement", "line_of", "path_of", "statements"]

Keys: TypeAlias = tuple[str | int, ...]
"""The way to a value: names of tables and keys, numbers within lists."""


def line_of(text: str, where: str) -> int:
    """The line of the key `where` or, when it is not there, of the table it belongs in; from 1 on, 0 for the top."""
    keys = path_of(where)
    lines: dict[Keys, int] = {}
    for found, line in _keys(text.splitlines()):
        lines.setdefault(found, line)
    while keys and keys not in lines:
        keys = keys[:-1]
    return lines.get(keys, 0)


class Statement(NamedTuple):
    """The header of a table, or a key with its value."""

    table: Keys
    """The table that it opens or stands in."""
    line: int
    """Its first line, from 1 on."""
    length: int
    """How many lines it has."""
    told: dict[str, Any] | None
    """What it says; None for a header, nothing for a line without a key."""


def statements(text: str) -> Iterator[Statement]:
    """Every statement of a TOML `text`, which is right, in its order."""
    return _statements(text.splitlines())


def _statements(lines: list[str]) -> Iterator[Statement]:
    counts: dict[Keys, int] = {}
    table: Keys = ()
    number = 0
    while number < len(lines):
        line = lines[number].strip()
        length, told = 1, None
        if line.startswith("["):
            table = _table(line, counts)
        else:
            length, told = _statement(lines, number)
        yield Statement(table, number + 1, length, told)
        number += length


def _keys(lines: list[str]) -> Iterator[tuple[Keys, int]]:
    """Every key of a TOML text with its line."""
    for table, line, length, told in _statements(lines):
        if told is None:
            yield table, line
            continue
        for keys, after in _within(told, lines[line - 1 : line - 1 + length]):
            yield (*table, *keys), line + after


def _table(line: str, counts: dict[Keys, int]) -> Keys:
    """What a header opens; `counts` has how many tables of a list were met."""
    head: Any = tomllib.loads(line)
    names: list[str] = []
    while isinstance(head, dict) and head:
        name, head = next(iter(head.items()))
        names.append(name)
        head = head[0] if isinstance(head, list) else head
    found: Keys = ()
    for position, name in enumerate(names):
        found = (*found, name)
        if line.startswith("[[") and position == len(names) - 1:
            counts[found] = counts.get(found, 0) + 1
        if found in counts:
            found = (*found, counts[found] - 1)
    return found


def _statement(lines: list[str], first: int) -> tuple[int, dict[str, Any]]:
    """How many lines the statement that begins at `first` has, and what it says."""
    for length in range(1, len(lines) - first + 1):
        try:
            return length, tomllib.loads("\n".join(lines[first : first + length]))
        except ValueError:  # no TOML yet, or a number of thousands of digits
            continue
    return 1, {}


def _within(told: Any, lines: list[str], before: Keys = ()) -> Iterator[tuple[Keys, int]]:
    """The keys in what a statement says, each with how many lines after the statement's first it stands."""
    if isinstance(told, dict):
        for name, value in told.items():
            yield (*before, name), 0
            yield from _within(value, lines, (*before, name))
    elif isinstance(told, list) and len(lines) > 1:
        complete = 0
        for after in range(len(lines)):
            count = _complete(lines[: after + 1], len(told))
            yield from (((*before, index), after) for index in range(complete, count))
            complete = max(complete, count)


def _complete(lines: list[str], most: int) -> int:
    """How many entries the list has that ends after these lines."""
    begun = "\n".join(lines).rstrip()
    for end in ("", "]"):
        try:
            told: Any = tomllib.loads(begun + "\n" + end if end else begun)
        except ValueError:  # no TOML yet, or a number of thousands of digits
            continue
        while isinstance(told, dict) and told:
            told = next(iter(told.values()))
        return len(told) if isinstance(told, list) else most
    return 0


def path_of(where: str) -> Keys:
    """The way that is written as in `cars[2].x`."""
    found = re.findall(r"([^.\[\]]+)|\[(\d+)\]", where)
    return tuple(int(number) if number else name for name, number in found)
