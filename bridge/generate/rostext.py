"""Definitions from ROS text: rosbags' parser for its meaning, its lines for the comments."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from rosbags.typesys.base import BaseType, Cardinality, Message, Type, TypesysError
from rosbags.typesys.base import Field as ParsedField
from rosbags.typesys.msg import MSGParser

from bridge.generate.comments import Comments, read_comments, without_comment
from bridge.generate.model import Constant, Definition, Field, Kind, Many, Part, TextError

__all__ = ["SUFFIXES", "read"]

SUFFIXES = {".msg": ("",), ".srv": ("Request", "Response"), ".action": ("Goal", "Result", "Feedback")}
"""Endings of the classes of each kind of file, behind the file's own name."""
_SAID = {
    "Request": "What `{}` is asked.",
    "Response": "What `{}` answers.",
    "Goal": "What `{}` is to reach.",
    "Result": "What `{}` came to.",
    "Feedback": "How far `{}` is.",
}
_TIMES = {"builtin_interfaces/Time": "time", "builtin_interfaces/Duration": "duration"}
_WIDE = re.compile(r"^([ \t]*)w(string(?:<=\d+)?(?:\[[<=\d]*\])?[ \t]+(\w+))", re.MULTILINE)
"""A field or constant of the one type that the parser does not know; it is read as a `string`."""
_MANY = {Cardinality.SCALAR: Many.ONE, Cardinality.ARRAY: Many.EXACTLY, Cardinality.SEQUENCE: Many.ANY}


def _package_of(path: Path, package: str | None) -> str:
    """The package that `path` belongs to: `package` if given, else the folder round `msg`, `srv` or `action`."""
    found = package or (path.parent.parent.name if path.parent.name in ("msg", "srv", "action") else "")
    if not found:
        raise TextError(f"{path} lies in no PACKAGE/msg folder; say its package with --package.")
    if not re.fullmatch(r"[a-z][a-z0-9_]*", found):
        raise TextError(f"A package is called by small letters, digits and _, not {found!r}.")
    return found


def read(path: Path, package: str | None = None) -> Definition:
    """The definition in the file at `path`; TextError for a file that cannot be read or is no ROS text."""
    suffixes = SUFFIXES.get(path.suffix)
    if suffixes is None:
        raise TextError(f"{path} ends neither in .msg nor in .srv nor in .action.")
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", path.stem):
        raise TextError(f"{path}: a type is called by letters, digits and _, not {path.stem!r}.")
    if not path.exists():
        raise TextError(f"{path} cannot be read: No such file or directory.")
    package = _package_of(path, package)
    try:
        text = path.resolve().read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise TextError(
            f"{path} cannot be read: {getattr(error, 'strerror', None) or 'no UTF-8'}."
        ) from error
    pieces = re.split(r"^-{3,}[ \t]*(?:#[^\n]*)?$", text, flags=re.MULTILINE)
    if len(pieces) != len(suffixes):
        raise TextError(f"{path} has {len(pieces)} parts divided by ---, not {len(suffixes)}.")
    line, parts = 1, []
    for piece, suffix in zip(pieces, suffixes, strict=True):
        parts.append(_part(piece, package, path.stem, suffix, f"{path}, line", line))
        line += piece.count("\n")
    return Definition(str(path), tuple(parts))


def _part(text: str, package: str, name: str, suffix: str, where: str, first: int) -> Part:
    wide = {found[3] for found in _WIDE.finditer(text)}
    message = _parsed(_WIDE.sub(r"\1\2", text), f"{package}/msg/{name}", where, first)
    comments = read_comments(text)
    told = comments.part or (_SAID[suffix].format(name) if suffix else "")
    names = [each.name for each in message.fields] + [each.name for each in message.constants]
    if twice := next((each for each in names if names.count(each) > 1), None):
        raise TextError(f"{where.removesuffix(', line')} defines {twice} twice.")
    fields = tuple(_field(each, each.name in wide, comments) for each in message.fields)
    constants = tuple(
        Constant(
            each.name,
            "wstring" if each.name in wide else each.typ.value,
            _unescaped(each.value),
            comments.of.get(each.name, ""),
        )
        for each in message.constants
    )
    return Part(package, f"{name}{suffix}", fields, constants, told)


def _parsed(text: str, name: str, where: str, first: int) -> Message:
    try:
        (message,) = MSGParser(f"MSG: {name}\n{text.strip()}\n").specification()
    except (TypesysError, ValueError) as error:
        for number, line in enumerate(text.splitlines(), first):
            if not _right(line, name):
                said = without_comment(line)[0].strip()
                raise TextError(f"{where} {number}: {said!r} is neither a field nor a constant.") from error
        raise TextError(f"{where} {first}: this is no ROS text.") from error
    return message


def _right(line: str, name: str) -> bool:
    try:
        return len(MSGParser(f"MSG: {name}\n{line.strip()}\n").specification()) == 1
    except (TypesysError, ValueError):
        return False


def _field(each: ParsedField, wide: bool, comments: Comments) -> Field:
    kind = _kind(each.typ)
    if wide:
        kind = replace(kind, base="wstring")
    return Field(each.name, kind, _unescaped(each.value), comments.of.get(each.name, ""))


def _kind(typ: Type) -> Kind:
    base = typ.ref.name.value if isinstance(typ.ref, BaseType) else typ.ref.name.replace("/msg/", "/")
    many = Many.AT_MOST if typ.cardinality is Cardinality.SEQUENCE and typ.size else _MANY[typ.cardinality]
    return Kind(_TIMES.get(base, base), typ.str_size, many, typ.size)


def _unescaped(value: Any) -> Any:
    """Texts without the backslashes that keep a quote from ending them."""
    if isinstance(value, list):
        return [_unescaped(each) for each in value]
    return re.sub(r"\\(['\"\\])", r"\1", value) if isinstance(value, str) else value
