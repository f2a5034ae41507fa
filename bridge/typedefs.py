"""What message types are made of, in the form in which `rosapi/message_details` tells it."""

from __future__ import annotations

import types
import typing
from typing import Any

import msgspec

from bridge.msgs import TYPES, Msg
from bridge.msgs.arrays import Float32Array, Float64Array, Int8Array

__all__ = ["typedefs"]

_NAMES: dict[Any, tuple[str, int]] = {
    float: ("float64", -1),
    int: ("int64", -1),
    bool: ("bool", -1),
    str: ("string", -1),
    bytes: ("uint8", 0),
    Float32Array: ("float32", 0),
    Float64Array: ("float64", 0),
    Int8Array: ("int8", 0),
}
"""ROS type and array length of each kind of field: -1 no array, 0 any length.

The width of a single number is not kept by the message classes; the widest is told.
"""


def typedefs(name: str) -> list[dict[str, Any]]:
    """The type called `name` and all that it is made of, each once; empty when it is not known."""
    found: dict[str, dict[str, Any]] = {}
    waiting = [name]
    while waiting:
        known = TYPES.get(waiting.pop())
        if known is not None and known.MSGTYPE not in found and known.MSGTYPE not in ("time", "duration"):
            found[known.MSGTYPE] = definition = _definition(known)
            waiting.extend(definition["fieldtypes"])
    return list(found.values())


def _definition(type: type[Msg]) -> dict[str, Any]:
    fields = msgspec.structs.fields(type)
    kinds = [_kind(field.type) for field in fields]
    return {
        "type": type.MSGTYPE,
        "fieldnames": [field.name for field in fields],
        "fieldtypes": [kind for kind, _ in kinds],
        "fieldarraylen": [length for _, length in kinds],
        "examples": ["[]" if length == 0 else "{}" if kind in TYPES else "" for kind, length in kinds],
        "constnames": [],
        "constvalues": [],
    }


def _kind(hint: Any) -> tuple[str, int]:
    if hint in _NAMES:
        return _NAMES[hint]
    if typing.get_origin(hint) is list:
        return _kind(typing.get_args(hint)[0])[0], 0
    if isinstance(hint, types.UnionType):
        return _kind(typing.get_args(hint)[0])
    return str(hint.MSGTYPE), -1
