"""Strict reading of JSON messages: an unknown field, another type or a number that is none is an error that names it.

Fields that are missing have their defaults, and `null` is a number that is not known.
"""

from __future__ import annotations

import difflib
import typing
from functools import lru_cache
from typing import Any, TypeVar

import msgspec

from bridge.codec import from_builtins, shown
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg

__all__ = ["MAX_INPUT", "decode", "read_message"]

M = TypeVar("M", bound=Msg)

MAX_INPUT = 65536
"""Longest message of a client [byte]."""


def decode(raw: bytes | bytearray | str) -> dict[str, Any]:
    """The object in a JSON text, `{}` for an empty one; ProtocolError for anything else, and for one that is too long."""
    if len(raw) > MAX_INPUT:
        raise ProtocolError(f"A message has at most {MAX_INPUT} bytes, not {len(raw)}.")
    if not raw.strip():
        return {}
    try:
        found = msgspec.json.decode(raw)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise ProtocolError(f"The message is not JSON: {error}.") from error
    if not isinstance(found, dict):
        raise ProtocolError(f"The message must be an object as {{…}}, not {shown(found)}.")
    return found


def read_message(found: object, cls: type[M]) -> M:
    """The message in decoded JSON; ProtocolError names the field, its value and what is allowed."""
    _check(found, cls, "")
    return from_builtins(found, cls)


def _check(found: object, cls: type[Msg], path: str) -> None:
    """ProtocolError for a field that `cls` does not have; what else is wrong is for `from_builtins`."""
    if not isinstance(found, dict):
        return
    parts = _parts(cls)
    for key, value in found.items():
        if key not in parts:
            raise ProtocolError(_unknown(key, cls, path, list(parts)))
        part = parts[key]
        if part is None:
            continue
        if isinstance(value, list):
            for index, each in enumerate(value):
                _check(each, part, f"{path}{key}[{index}].")
        else:
            _check(value, part, f"{path}{key}.")


def _unknown(key: str, cls: type[Msg], path: str, names: list[str]) -> str:
    near = difflib.get_close_matches(key[:64], names, 1)
    hint = f"did you mean {path}{near[0]}?" if near else f"it has {', '.join(names)}."
    return f"{cls.MSGTYPE} has no field {shown(f'{path}{key}')}; {hint}"


@lru_cache(maxsize=1024)
def _parts(cls: type[Msg]) -> dict[str, type[Msg] | None]:
    """The fields of `cls` by their names in JSON, with the class of their messages, None for those that have none."""
    return {field.encode_name: _message_class(field.type) for field in msgspec.structs.fields(cls)}


def _message_class(hint: Any) -> type[Msg] | None:
    while typing.get_origin(hint) is not None:
        hint = typing.get_args(hint)[0]
    return hint if isinstance(hint, type) and issubclass(hint, Msg) else None
