"""TOML files of the simulation: read into a struct, and a fault in one is told with file, line, key, value and reason.

world = read(text, World, "lake.toml")
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

import msgspec

__all__ = ["FileFault", "fault", "line_of", "read", "text_of"]

T = TypeVar("T")
Keys: TypeAlias = tuple[str | int, ...]
"""The way to a value: names of tables and keys, numbers within lists."""

_LARGEST = 1_000_000
"""Of a file [bytes]; nobody writes a longer one on purpose."""


_GREATEST = 1e9
"""Of a number: what lies beyond is a slip, and overflows in what is reckoned with it."""


class FileFault(ValueError):
    """A file that cannot be used; the text is one sentence."""


def text_of(path: Path) -> str:
    """What the file says; FileFault when it cannot be read."""
    try:
        if path.stat().st_size > _LARGEST:
            raise FileFault(f"{path.name}: has more than {_LARGEST:,} bytes.")
        return path.read_text(encoding="utf-8")
    except OSError as problem:
        raise FileFault(f"{path.name}: cannot be read ({problem.strerror}).") from problem
    except UnicodeDecodeError as problem:
        line = path.read_bytes()[: problem.start].count(b"\n") + 1
        raise FileFault(f"{path.name}, line {line}: is no UTF-8 text.") from problem


def read(text: str, kind: type[T], source: str) -> T:
    """The `kind` that a TOML `text` describes; FileFault calls it `source`."""
    try:
        told = tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        raise FileFault(_no_toml(str(problem), text, source)) from problem
    except RecursionError as problem:
        raise FileFault(f"{source}: is not TOML: it is nested too deep.") from problem
    try:
        found = msgspec.convert(told, kind)
    except msgspec.ValidationError as problem:
        where, reason = _explained(str(problem), told, kind)
        raise FileFault(fault(text, source, where, reason)) from problem
    for where, value in _numbers(told):
        if not abs(value) <= _GREATEST:
            reason = f"must be a number from -{_GREATEST:.0e} to {_GREATEST:.0e}, not {_shown(value)}"
            raise FileFault(fault(text, source, where, reason))
    return found


def _numbers(told: Any, where: str = "") -> Iterator[tuple[str, float]]:
    """Every number that is said, infinities and NaN among them, with its key."""
    if isinstance(told, dict):
        for name, value in told.items():
            yield from _numbers(value, f"{where}.{name}".lstrip("."))
    elif isinstance(told, list):
        for number, value in enumerate(told):
            yield from _numbers(value, f"{where}[{number}]")
    elif isinstance(told, int | float):
        yield where, told


def fault(text: str, source: str, where: str, reason: str) -> str:
    """One sentence about the key `where`, as in `cars[2].x`, of the file `source` with this `text`."""
    line = line_of(text, where)
    place = f"{source}, line {line}" if line else source
    return f"{place}: {where}: {reason}." if where else f"{place}: {reason}."


def line_of(text: str, where: str) -> int:
    """The line of the key `where` or, when it is not there, of the table it belongs in; from 1 on, 0 for the top."""
    keys = _steps(where)
    lines: dict[Keys, int] = {}
    for found, line in _keys(text.splitlines()):
        lines.setdefault(found, line)
    while keys and keys not in lines:
        keys = keys[:-1]
    return lines.get(keys, 0)


def _keys(lines: list[str]) -> Iterator[tuple[Keys, int]]:
    """Every key of a TOML text with its line."""
    counts: dict[Keys, int] = {}
    table: Keys = ()
    number = 0
    while number < len(lines):
        line = lines[number].strip()
        if line.startswith("["):
            table = _table(line, counts)
            yield table, number + 1
            length = 1
        else:
            length, told = _statement(lines, number)
            for keys, after in _within(told, lines[number : number + length]):
                yield (*table, *keys), number + 1 + after
        number += length


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
        except tomllib.TOMLDecodeError:
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
        except tomllib.TOMLDecodeError:
            continue
        while isinstance(told, dict) and told:
            told = next(iter(told.values()))
        return len(told) if isinstance(told, list) else most
    return 0


def _no_toml(said: str, text: str, source: str) -> str:
    found = re.fullmatch(r"(.*) \(at line (\d+), column (\d+)\)", said, re.DOTALL)
    if found is None:
        said = said.replace(" (at end of document)", " where the file ends")
        return f"{source}, line {len(text.splitlines())}: is not TOML: {said[:1].lower()}{said[1:]}."
    what = f"{found[1][:1].lower()}{found[1][1:]}"
    return f"{source}, line {found[2]}: is not TOML: {what} (column {found[3]})."


_KINDS = {
    "float": "a number",
    "int": "a whole number",
    "str": "a text in quotes",
    "bool": "true or false",
    "object": "a table",
    "array": "a list",
}
_BOUNDS = {"<=": "at most", ">=": "at least", "<": "below", ">": "above"}


def _explained(said: str, told: Any, kind: Any) -> tuple[str, str]:
    """The key and the reason of what msgspec `said` about what the file `told`, which should be a `kind`."""
    what, _, where = said.partition(" - at `$")
    where = where.rstrip("`").lstrip(".")
    for pattern, reason in (
        (r"Object missing required field `(.*)`", "is missing"),
        (r"Object contains unknown field `(.*)`", "is not known here"),
    ):
        found = re.fullmatch(pattern, what)
        if found:
            return f"{where}.{found[1]}".lstrip("."), reason
    wanted = _wanted(what)
    if what.startswith("Invalid enum value"):
        wanted = f"one of {', '.join(_choices(msgspec.inspect.type_info(kind), _steps(where)))}"
    return where, f"must be {wanted}, not {_shown(_at(told, where))}"


def _choices(kind: Any, keys: Keys) -> list[str]:
    """What may be said at `keys` of a `kind`, where it is one of some words."""
    if isinstance(kind, msgspec.inspect.UnionType):
        return [word for each in kind.types for word in _choices(each, keys)]
    if isinstance(kind, msgspec.inspect.LiteralType):
        return [str(value) for value in kind.values]
    if not keys:
        return []
    if isinstance(kind, msgspec.inspect.StructType):
        return [
            word
            for field in kind.fields
            if field.encode_name == keys[0]
            for word in _choices(field.type, keys[1:])
        ]
    return _choices(getattr(kind, "item_type", None), keys[1:])


def _wanted(what: str) -> str:
    """What was expected, in plain words."""
    length = re.search(r"Expected `array` of length (\d+)", what)
    if length:
        return f"a list of {length[1]}"
    bound = re.search(r"Expected `(\w+)` (<=|>=|<|>) (-?[\d.]+)", what)
    if bound:
        return f"{_KINDS.get(bound[1], bound[1])} {_BOUNDS[bound[2]]} {float(bound[3]):g}"
    longer = re.search(r"Expected `str` of length (<=|>=) (\d+)", what)
    if longer:
        return f"a text of {_BOUNDS[longer[1]]} {longer[2]} character{'s' * (longer[2] != '1')}"
    kind = re.search(r"Expected `(\w+)", what)
    return _KINDS.get(kind[1], kind[1]) if kind else what[:1].lower() + what[1:]


def _at(told: Any, where: str) -> Any:
    value = told
    for key in _steps(where):
        try:
            value = value[key]
        except (KeyError, IndexError, TypeError):
            return None
    return value


def _steps(where: str) -> Keys:
    """The way that is written as in `cars[2].x`."""
    found = re.findall(r"([^.\[\]]+)|\[(\d+)\]", where)
    return tuple(int(number) if number else name for name, number in found)


def _shown(value: Any) -> str:
    shown = str(value).lower() if isinstance(value, bool) else repr(value)
    return shown if len(shown) <= 60 else f"{shown[:57]}..."
