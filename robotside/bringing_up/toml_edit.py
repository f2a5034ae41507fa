"""Values put into a TOML text that a person wrote: everything else in it, comments too, stays as it is.

text = edited(text, {("serve", "robot"): "sim:patrol", ("gateways", "mqtt", "url"): "mqtt://broker"})
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from typing import Any, TypeAlias

from bridge.core.toml_lines import Keys, Statement, lines_of, statements

__all__ = ["CannotEdit", "Value", "edited"]

Value: TypeAlias = str | bool | int | float | tuple[str, ...]


class CannotEdit(ValueError):
    """The text is written in a way that this cannot change; the text names the place."""


def edited(text: str, values: Mapping[tuple[str, ...], Value | None]) -> str:
    """`text`, which is right, with `values` by table and key, and without those that are None.

    CannotEdit where that would change anything else.
    """
    wanted = tomllib.loads(text)
    result = text
    for place, value in values.items():
        _put(wanted, place, value)
        if value is None:
            result = _without(result, place[:-1], place[-1])
        else:
            result = _with(result, place[:-1], place[-1], value)
    try:
        said: Any = tomllib.loads(result)
    except ValueError:
        said = None
    if said != wanted:
        tables = ", ".join(dict.fromkeys(f"[{'.'.join(place[:-1])}]" for place in values))
        raise CannotEdit(f"it does not write {tables} as tables of their own")
    return result


def _put(content: dict[str, Any], place: tuple[str, ...], value: Value | None) -> None:
    for name in place[:-1]:
        if value is None and name not in content:
            return
        inner = content.setdefault(name, {})
        if not isinstance(inner, dict):
            raise CannotEdit(f"its {name} is no table")
        content = inner
    if value is None:
        content.pop(place[-1], None)
    else:
        content[place[-1]] = list(value) if isinstance(value, tuple) else value


def _without(text: str, table: Keys, key: str) -> str:
    """The text without a key; the comment behind it stays, in a line of its own."""
    lines = lines_of(text)
    for each in statements(text):
        if each.table == table and each.told is not None and key in each.told:
            comment = _comment(lines, each).strip()
            return _joined(lines, each, [comment] if comment else [])
    return text


def _with(text: str, table: Keys, key: str, value: Value) -> str:
    lines = lines_of(text)
    said = f"{key} = {_written(value)}"
    header, last = 0, 0
    for each in statements(text):
        if each.table != table:
            continue
        if each.told is None:
            header = last = each.line
        elif key in each.told:
            return _joined(lines, each, [said + _comment(lines, each)])
        elif each.told:
            last = each.line + each.length - 1
    if header:
        lines.insert(last, said)
    else:
        lines += [*[""][: bool(lines)], f"[{'.'.join(map(str, table))}]", said]
    return "\n".join(lines) + "\n"


def _joined(lines: list[str], each: Statement, instead: list[str]) -> str:
    first = each.line - 1
    return "\n".join([*lines[:first], *instead, *lines[first + each.length :]]) + "\n"


def _comment(lines: list[str], each: Statement) -> str:
    """The comment behind a statement, with the space before it; empty for none."""
    *before, last = lines[each.line - 1 : each.line - 1 + each.length]
    for place, letter in enumerate(last):
        if letter != "#":
            continue
        try:
            told = tomllib.loads("\n".join([*before, last[:place]]))
        except ValueError:
            continue  # it stands in a text
        if told == each.told:
            return last[len(last[:place].rstrip()) :]
    return ""


def _written(value: Value) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(map(_written, value))}]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value).lower() if isinstance(value, bool) else repr(value)
