"""What message types are made of, in the form in which `rosapi/message_details` tells it."""

from __future__ import annotations

import builtins
import functools
import re
from typing import Any

import msgspec

from bridge.msgs import TYPES, Msg

__all__ = ["constants", "typedefs"]

_ROSTYPE = re.compile(r"(?P<base>[\w/]+)(?:<=\d+)?(?P<array>\[(?P<bound><=)?(?P<length>\d*)\])?")
_BUILT_IN = ("time", "duration")


def typedefs(type: str | builtins.type[Msg]) -> list[dict[str, Any]]:
    """`type`, by its ROS 1 name or class, and all that it is made of, each once; empty when it is not known.

    Each has its fields in order with the exact type of one element and `fieldarraylen`: -1 no array, 0 any length (a bound
    cannot be told), else the length. `examples` are the defaults as text, `[]` for an array, `{}` for a message.
    Times are built in, as in ROS 1: they come without a definition.
    """
    first = TYPES.get(type) if isinstance(type, str) else type
    found: dict[str, dict[str, Any]] = {}
    waiting = [] if first is None else [first]
    while waiting:
        known = waiting.pop()
        if known.MSGTYPE not in found and known.MSGTYPE not in _BUILT_IN:
            found[known.MSGTYPE] = _definition(known)
            waiting += reversed(_inside(known))
    return [{**each} for each in found.values()]


def constants(type: builtins.type[Msg]) -> dict[str, Any]:
    """The constants of a class by name, in their order."""
    return {
        name: value
        for base in reversed(type.__mro__)
        for name, value in vars(base).items()
        if isinstance(value, (bool, int, float, str)) and name[0] != "_" and name != "MSGTYPE"
    }


@functools.lru_cache(maxsize=1024)
def _definition(type: builtins.type[Msg]) -> dict[str, Any]:
    fields = [field for field in msgspec.structs.fields(type) if field.name not in _unsent(type)]
    kinds = [_kind(rostype) for rostype in type.ROSTYPES]
    told = constants(type)
    return {
        "type": type.MSGTYPE,
        "fieldnames": [field.encode_name for field in fields],
        "fieldtypes": [kind for kind, _ in kinds],
        "fieldarraylen": [length for _, length in kinds],
        "examples": [_example(field, *kind) for field, kind in zip(fields, kinds, strict=True)],
        "constnames": list(told),
        "constvalues": [str(value) for value in told.values()],
    }


def _unsent(type: builtins.type[Msg]) -> tuple[str, ...]:
    return type.__struct_fields__[len(type.ROSTYPES) :]


def _inside(type: builtins.type[Msg]) -> list[builtins.type[Msg]]:
    """The classes of its fields, in their order."""
    hints = (field.type for field in msgspec.structs.fields(type))
    return [found for hint in hints if (found := _message(hint)) is not None]


def _message(hint: Any) -> type[Msg] | None:
    """The message class within an annotation, if there is one."""
    if isinstance(hint, type):
        return hint if issubclass(hint, Msg) else None
    inner = (_message(each) for each in getattr(hint, "__args__", ()))
    return next((found for found in inner if found is not None), None)


def _kind(rostype: str) -> tuple[str, int]:
    found = _ROSTYPE.fullmatch(rostype)
    if found is None or not found["array"]:
        return found["base"] if found else rostype, -1
    return found["base"], 0 if found["bound"] else int(found["length"] or 0)


def _example(field: msgspec.structs.FieldInfo, kind: str, length: int) -> str:
    if length >= 0:
        return "[]"
    return "{}" if "/" in kind or kind in _BUILT_IN else str(field.default)
