"""Descriptions of message types, in the form of `rosapi/message_details`."""

from __future__ import annotations

import builtins
import functools
from typing import Any

import msgspec

from bridge.codec.fields import Field, ros_fields
from bridge.msgs import TYPES, Msg

__all__ = ["constants", "constant_types", "parts", "typedefs"]

_BUILT_IN = ("time", "duration")
_ROS2_TIMES = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}


def typedefs(type: str | builtins.type[Msg], *, ros2: bool = False) -> list[dict[str, Any]]:
    """The description of `type`, a ROS 1 name or class, and of all its parts, each once; empty when it is not known.

    Each has its fields in order with the exact type of one element and `fieldarraylen`: -1 for no array, 0 for any
    length (a bound cannot be described), else the length. `examples` are the defaults as text, `[]` for an array,
    `{}` for a message. Times are built in, as in ROS 1: they come without a description. With `ros2` times and headers are
    those of ROS 2.
    """
    found = [{**_definition(each, ros2)} for each in parts(type)]
    if ros2:
        used = {kind for each in found for kind in each["fieldtypes"]}
        found += [_ros2_time(name) for name in _ROS2_TIMES.values() if name in used]
    return found


def parts(type: str | builtins.type[Msg]) -> list[builtins.type[Msg]]:
    """The class of `type`, a ROS 1 name or class, and those of all its parts but times, each once; empty when it is not
    known."""
    first = TYPES.get(type) if isinstance(type, str) else type
    found: dict[str, builtins.type[Msg]] = {}
    waiting = [] if first is None else [first]
    while waiting:
        known = waiting.pop()
        if known.MSGTYPE not in found and known.MSGTYPE not in _BUILT_IN:
            found[known.MSGTYPE] = known
            waiting += reversed([field.type for field in ros_fields(known, False) if field.type is not None])
    return list(found.values())


def constants(type: builtins.type[Msg]) -> dict[str, Any]:
    """The constants of a class by name, in their order."""
    return {name: value for base in reversed(type.__mro__) for name, value in _own(base).items()}


def constant_types(type: builtins.type[Msg]) -> dict[str, str]:
    """The ROS type of each constant of a class by name, of those that have one."""
    return {
        name: rostype
        for base in reversed(type.__mro__)
        for name, rostype in zip(_own(base), vars(base).get("CONSTTYPES", ()), strict=False)
    }


def _own(base: builtins.type) -> dict[str, Any]:
    return {
        name: value
        for name, value in vars(base).items()
        if isinstance(value, (bool, int, float, str)) and name[0] != "_" and name != "MSGTYPE"
    }


@functools.lru_cache(maxsize=1024)
def _definition(type: builtins.type[Msg], ros2: bool) -> dict[str, Any]:
    fields = ros_fields(type, ros2)
    times = _ROS2_TIMES if ros2 else {}
    defaults = {field.name: field.default for field in msgspec.structs.fields(type)}
    told = constants(type)
    return {
        "type": type.MSGTYPE,
        "fieldnames": [field.key for field in fields],
        "fieldtypes": [times.get(field.base, field.base) for field in fields],
        "fieldarraylen": [(field.length or 0) if field.array else -1 for field in fields],
        "examples": [_example(field, defaults[field.name]) for field in fields],
        "constnames": list(told),
        "constvalues": [str(value) for value in told.values()],
    }


def _ros2_time(name: str) -> dict[str, Any]:
    return {
        "type": name,
        "fieldnames": ["sec", "nanosec"],
        "fieldtypes": ["int32", "uint32"],
        "fieldarraylen": [-1, -1],
        "examples": ["0", "0"],
        "constnames": [],
        "constvalues": [],
    }


def _example(field: Field, default: object) -> str:
    if field.array:
        return "[]"
    return "{}" if field.type is not None else str(default)
