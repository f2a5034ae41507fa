"""TOML files, read into a struct; a fault in one is a sentence with file, line, key, value and what is allowed.

world = read(text, World, "lake.toml")
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from bridge.core.toml_lines import Keys, line_of, path_of

__all__ = ["MAX_BYTES", "MAX_FAULTS", "FileFault", "fault", "read", "read_all", "shown", "text_of"]

T = TypeVar("T")

MAX_BYTES = 1_000_000
"""Of a file [bytes]; a longer one is a mistake."""
MAX_NUMBER = 1e9
"""Greatest amount of a number, unless the reader allows more; beyond it, sums and products overflow."""
MAX_DEPTH = 32
"""Tables and lists within each other; more is nobody's settings."""
_NAME, _SPACE = r"(?<![\w\-\"'])[\w\-\"']++", r"[ \t]*+"
_TOO_DEEP = re.compile(rf"(?:{_NAME}{_SPACE}\.{_SPACE}){{{MAX_DEPTH}}}|(?:[\[{{]{_SPACE}){{{MAX_DEPTH}}}")
MAX_FAULTS = 50
"""Of one file; more of them tell nothing more."""
MAX_LETTERS = 60
"""Of a wrong value in a sentence; the rest is cut off."""


class FileFault(ValueError):
    """A file that cannot be used; the text is one sentence that begins with the file and the line."""

    where = ""
    """The key that is wrong, as in `cars[2].x`; empty when the fault is the whole file's."""
    reason = ""
    """What is wrong with it, without a full stop."""
    known: tuple[str, ...] = ()
    """The keys that are allowed, where `where` is an unknown one; empty for every other fault."""
    line = 0
    """Where it is, from 1 on; 0 when the fault is the whole file's."""


def fault(
    text: str, source: str, where: str, reason: str, *, line: int = 0, known: tuple[str, ...] = ()
) -> FileFault:
    """The fault of the key `where` of the file `source` with this `text`, in its `line`, which is looked for when it is 0."""
    line = line or (line_of(text, where) if where else 0)
    place = f"{source}, line {line}" if line else source
    found = FileFault(" ".join(f"{place}: {f'{where}: ' if where else ''}{reason}.".splitlines()))
    found.where, found.reason, found.known, found.line = where, reason, known, line
    return found


def text_of(path: Path) -> str:
    """The text of the file; FileFault when it cannot be read."""
    try:
        if path.stat().st_size > MAX_BYTES:
            raise fault("", path.name, "", f"has more than {MAX_BYTES:,} bytes")
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise fault("", path.name, "", f"cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        line = path.read_bytes()[: error.start].count(b"\n") + 1
        raise fault("", path.name, "", "is no UTF-8 text", line=line) from error


def read(text: str, kind: type[T], source: str, *, largest: float = MAX_NUMBER) -> T:
    """The `kind` of struct that a TOML `text` describes; FileFault, which names the `source`, when it does not.

    No number is NaN or infinite, or has an amount above `largest`.
    """
    content = _parsed(text, source)
    try:
        found = msgspec.convert(content, kind)
    except msgspec.ValidationError as error:
        raise _mismatch(str(error), text, source, content, kind) from error
    for found_fault in _too_large(content, text, source, largest):
        raise found_fault
    return found


def read_all(
    text: str, kind: type[T], source: str, *, largest: float = MAX_NUMBER
) -> tuple[T | None, list[FileFault]]:
    """As `read`, with all faults of the text at once, at most `MAX_FAULTS`, in the order of their lines.

    What is at fault is left out of the struct, or empty where it must be there; the struct is None where that cannot be done.
    """
    try:
        content = _parsed(text, source)
    except FileFault as error:
        return None, [error]
    faults: list[FileFault] = []
    while len(faults) < MAX_FAULTS:
        try:
            found = msgspec.convert(content, kind)
        except msgspec.ValidationError as error:
            faults.append(_mismatch(str(error), text, source, content, kind))
            if not _leave_out(content, kind, _keys_of(str(error))):
                break
            continue
        large = list(_too_large(content, text, source, largest))
        faults += large[: MAX_FAULTS - len(faults)]
        if all(_leave_out(content, kind, path_of(one.where)) for one in large):
            found = msgspec.convert(content, kind) if large else found
            return found, sorted(faults, key=lambda one: one.line)
        break
    return None, sorted(faults, key=lambda one: one.line)


def _parsed(text: str, source: str) -> dict[str, Any]:
    if _TOO_DEEP.search(text):  # before it is read: that takes the square of the depth
        raise fault("", source, "", f"is nested deeper than {MAX_DEPTH} levels")
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise fault("", source, "", "is not TOML: it is nested too deep") from error
    except ValueError as error:  # also of a number with more digits than Python reads
        raise _no_toml(str(error), text, source) from error


def _too_large(content: Any, text: str, source: str, largest: float) -> Iterator[FileFault]:
    """A fault of each number that is NaN, infinite, or has an amount above `largest`."""
    for where, value in _numbers(content):
        if not abs(value) <= min(largest, sys.float_info.max):
            bounds = f" from -{largest:.0e} to {largest:.0e}" if largest <= sys.float_info.max else ""
            yield fault(text, source, where, f"must be a number{bounds}, not {shown(value)}")


def _leave_out(content: Any, kind: Any, keys: Keys) -> bool:
    """Take away from a file's `content` what is at fault at `keys`, so that the rest can be read; False where that cannot be."""
    if not keys:
        return False
    *way, last = keys
    try:
        holder = content
        for step in way:
            holder = holder[step]
    except (LookupError, TypeError):
        return False
    if not isinstance(holder, dict) or not isinstance(last, str):
        return _leave_out(content, kind, tuple(way))
    structs = _types(msgspec.inspect.type_info(kind), tuple(way))
    fields = [field for one in structs for field in getattr(one, "fields", ()) if field.encode_name == last]
    if any(field.required for field in fields):
        if holder.get(last) == "" or not any(isinstance(one.type, msgspec.inspect.StrType) for one in fields):
            return False
        holder[last] = ""
    else:
        holder.pop(last, None)
    return True


def _keys_of(error: str) -> Keys:
    """The way to what msgspec's `error` is about."""
    what, _, where = error.partition(" - at `$")
    named = _NAMED.fullmatch(what)
    return (*path_of(where.rstrip("`").lstrip(".")), *((named[2],) if named else ()))


def shown(value: object) -> str:
    """A wrong value as a sentence repeats it: as the file has it, and not at any length."""
    try:
        letters = str(value).lower() if isinstance(value, bool) else repr(value)
    except ValueError:  # Python writes no number of thousands of digits
        return "a number of thousands of digits"
    return letters if len(letters) <= MAX_LETTERS else f"{letters[: MAX_LETTERS - 3]}..."


def _numbers(content: Any, where: str = "") -> Iterator[tuple[str, float]]:
    """Every number of the file, infinities and NaN among them, with its key."""
    if isinstance(content, dict):
        for name, value in content.items():
            yield from _numbers(value, f"{where}.{name}".lstrip("."))
    elif isinstance(content, list):
        for number, value in enumerate(content):
            yield from _numbers(value, f"{where}[{number}]")
    elif isinstance(content, int | float):
        yield where, content


def _no_toml(error: str, text: str, source: str) -> FileFault:
    found = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", error, re.DOTALL)
    what, line, place = error.rstrip("."), 0, ""
    if found:
        what, line = found[1], int(found[2] or len(text.splitlines()))
        place = f" (column {found[3]})" if found[3] else " where the file ends"
    return fault(text, source, "", f"is not TOML: {what[:1].lower()}{what[1:]}{place}", line=line)


_NAMED = re.compile(r"Object (missing required|contains unknown) field `(.*)`", re.DOTALL)
_KINDS = {
    "float": "a number",
    "int": "a whole number",
    "str": "a text in quotes",
    "bool": "true or false",
    "object": "a table",
    "array": "a list",
}
_LISTS: dict[Any, str] = {
    msgspec.inspect.StructType: " of [[{}]] tables",
    msgspec.inspect.StrType: " of texts in quotes",
}
_BOUNDS = {"<=": "at most", ">=": "at least", "<": "below", ">": "above"}


def _mismatch(error: str, text: str, source: str, content: Any, kind: Any) -> FileFault:
    """The fault behind msgspec's `error` about a file's `content` that should be a `kind`."""
    what, _, where = error.partition(" - at `$")
    where = where.rstrip("`").lstrip(".")
    types = list(_types(msgspec.inspect.type_info(kind), path_of(where)))
    named = _NAMED.fullmatch(what)
    if named:
        key = f"{where}.{named[2]}".lstrip(".")
        if named[1] == "missing required":
            return fault(text, source, key, "is missing")
        known = tuple(field.encode_name for one in types for field in getattr(one, "fields", ()))
        return fault(text, source, key, "is not known here", known=known)
    value = content
    for step in path_of(where):
        value = value[step]
    return fault(text, source, where, f"must be {_wanted(what, where, types)}, not {shown(value)}")


def _types(kind: Any, keys: Keys) -> Iterator[Any]:
    """What msgspec accepts at `keys` of a `kind`; several types of a union."""
    if isinstance(kind, msgspec.inspect.UnionType):
        for each in kind.types:
            yield from _types(each, keys)
    elif not keys:
        yield kind
    elif isinstance(kind, msgspec.inspect.StructType):
        for field in kind.fields:
            if field.encode_name == keys[0]:
                yield from _types(field.type, keys[1:])
    elif hasattr(kind, "item_type"):
        yield from _types(kind.item_type, keys[1:])


def _wanted(what: str, where: str, types: list[Any]) -> str:
    """What is allowed at `where`, in plain words."""
    choices = [str(value) for one in types for value in getattr(one, "values", ())]
    if choices:
        return f"one of {', '.join(choices)}"
    length = re.search(r"Expected `array` of length (\d+)", what)
    if length:
        items = {type(item) for one in types for item in getattr(one, "item_types", ())}
        return f"a list of {length[1]}{' numbers' * (items == {msgspec.inspect.FloatType})}"
    if "Expected `array`" in what:
        items = {type(getattr(one, "item_type", None)) for one in types}
        return "a list" + "".join(_LISTS.get(item, "") for item in items).format(where)
    bound = re.search(r"Expected `(\w+)` (<=|>=|<|>) (-?[\d.]+)", what)
    if bound:
        return f"{_KINDS.get(bound[1], bound[1])} {_BOUNDS[bound[2]]} {float(bound[3]):g}"
    longer = re.search(r"Expected `str` of length (<=|>=) (\d+)", what)
    if longer:
        return f"a text of {_BOUNDS[longer[1]]} {longer[2]} character{'s' * (longer[2] != '1')}"
    if what == "Number out of range":
        return "a number that can be reckoned with"
    found = re.search(r"Expected `(\w+)", what)
    return _KINDS.get(found[1], found[1]) if found else what[:1].lower() + what[1:]
