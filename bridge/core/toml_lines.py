"""Line numbers of the keys of a TOML text, which the parser of the standard library does not give."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

__all__ = ["Keys", "Statement", "line_of", "lines_of", "path_of", "statements"]

Keys: TypeAlias = tuple[str | int, ...]
"""The way to a value: names of tables and keys, numbers within lists."""
_TOKEN = re.compile(
    r""""{3}(?:\\.|[^\\])*?"{3,5}|'{3}.*?'{3,5}|"(?:\\.|[^"\\\n])*"|'[^'\n]*'|\#[^\n]*|[\[\]{},\n]""",
    re.DOTALL,
)
"""Strings, comments, and what opens, closes, divides or ends."""
_SPACE = re.compile(r"(?:\s+|\#[^\n]*)*")
"""Space and comments, also none."""


def line_of(text: str, where: str) -> int:
    """The line of the key `where` or, when it is not there, of the table it belongs in; from 1 on, 0 for the top."""
    keys, lines = path_of(where), _lines_of(text)
    while keys and keys not in lines:
        keys = keys[:-1]
    return lines.get(keys, 0)


@lru_cache(maxsize=2)
def _lines_of(text: str) -> dict[Keys, int]:
    """The line of every key; kept, as a text with one fault has others."""
    lines: dict[Keys, int] = {}
    for found, line in _keys(text):
        lines.setdefault(found, line)
    return lines


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


def lines_of(text: str) -> list[str]:
    """The lines of a TOML text as statements count them: other signs that end a line elsewhere may stand in a string."""
    plain = text.replace("\r\n", "\n").removesuffix("\n")
    return plain.split("\n") if plain else []


def statements(text: str) -> Iterator[Statement]:
    """Every statement of a TOML `text`, which is right, in its order."""
    return (statement for statement, _ in _statements(text))


def _statements(text: str) -> Iterator[tuple[Statement, str]]:
    """Each with its text."""
    counts: dict[Keys, int] = {}
    table: Keys = ()
    number = 1
    for part in _parts(text.replace("\r\n", "\n")):
        length, told = part.count("\n") + 1, None
        if part.lstrip().startswith("["):
            table = _table(part, counts)
        else:
            told = _told(part)
        yield Statement(table, number, length, told), part
        number += length


def _parts(text: str) -> Iterator[str]:
    """The text, divided where a line ends and nothing that was begun goes on in the next."""
    begun = depth = 0
    for token in _TOKEN.finditer(text):
        if token[0] in "[{":
            depth += 1
        elif token[0] in "]}":
            depth -= 1
        elif token[0] == "\n" and depth <= 0:
            yield text[begun : token.start()]
            begun, depth = token.end(), 0
    if begun < len(text):
        yield text[begun:]


def _told(part: str) -> dict[str, Any]:
    try:
        return tomllib.loads(part)
    except (ValueError, RecursionError):  # no TOML, or a number of thousands of digits
        return {}


def _keys(text: str) -> Iterator[tuple[Keys, int]]:
    """Every key of a TOML text with its line."""
    for (table, line, length, told), part in _statements(text):
        if told is None:
            yield table, line
            continue
        for keys, after in _within(told, _entries(part) if length > 1 else []):
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


def _within(told: Any, entries: list[int], before: Keys = ()) -> Iterator[tuple[Keys, int]]:
    """The keys in what a statement says, each with how many lines after the statement's first it stands."""
    if isinstance(told, dict):
        for name, value in told.items():
            yield (*before, name), 0
            yield from _within(value, entries, (*before, name))
    elif isinstance(told, list):
        yield from (((*before, index), after) for index, after in enumerate(entries[: len(told)]))


def _entries(part: str) -> list[int]:
    """How many lines after the first of a statement each entry of its first list begins."""
    found: list[int] = []
    depth = level = lines = at = 0
    for token in _TOKEN.finditer(part):
        sign = token[0]
        opens = sign == "[" and not level
        if sign in "[{":
            depth += 1
            level = depth if opens else level
        elif sign in "]}":
            depth -= 1
        if level and depth < level:
            break
        if opens or (sign == "," and depth == level):
            space = _SPACE.match(part, token.end())
            start = space.end() if space else token.end()
            lines, at = lines + part.count("\n", at, start), start
            found.append(lines)
    return found


def path_of(where: str) -> Keys:
    """The way that is written as in `cars[2].x`."""
    found = re.findall(r"([^.\[\]]+)|\[(\d+)\]", where)
    return tuple(int(number) if number else name for name, number in found)
