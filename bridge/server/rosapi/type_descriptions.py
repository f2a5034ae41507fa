"""Descriptions of message types, in the form of `rosapi/message_details`."""

from __future__ import annotations

import builtins
import functools
from typing import Any

import msgspec

from bridge.codec.fields import Field, fields_of
from bridge.msgs import TYPES, Msg

__all__ = ["constants", "typedefs"]

_BUILT_IN = ("time", "duration")


def typedefs(type: str | builtins.type[Msg]) -> list[dict[str, Any]]:
    """The description of `type`, a ROS 1 name or class, and of all its parts, each once; empty when it is not known.

    Each has its fields in order with the exact type of one element and `fieldarraylen`: -1 for no array, 0 for any
    length (a bound cannot be described), else the length. `examples` are the defaults as text, `[]` for an array,
    `{}` for a message. Times are built in, as in ROS 1: they come without a description.
    """
    first = TYPES.get(type) if isinstance(type, str) else type
    found: dict[str, dict[str, Any]] = {}
    waiting = [] if first is None else [first]
    while waiting:
        known = waiting.pop()
        if known.MSGTYPE not in found and known.MSGTYPE not in _BUILT_IN:
            found[known.MSGTYPE] = _definition(known)
            waiting += reversed([field.type for field in fields_of(known) if field.type is not None])
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
    fields = fields_of(type)
    defaults = {field.name: field.default for field in msgspec.structs.fields(type)}
    told = constants(type)
    return {
        "type": type.MSGTYPE,
        "fieldnames": [field.key for field in fields],
        "fieldtypes": [field.base for field in fields],
        "fieldarraylen": [(field.length or 0) if field.array else -1 for field in fields],
        "examples": [_example(field, defaults[field.name]) for field in fields],
        "constnames": list(told),
        "constvalues": [str(value) for value in told.values()],
    }


def _example(field: Field, default: object) -> str:
    if field.array:
        return "[]"
    return "{}" if field.type is not None else str(default)
