"""The fields of a message class, each with its exact ROS type."""

from __future__ import annotations

import functools
import re
import types
import typing
from dataclasses import dataclass
from typing import Any

import msgspec

from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array, Float64Array, Int8Array
from bridge.msgs.std_msgs import Time

__all__ = ["CODES", "HEADER", "TIMES", "Field", "bare", "fields_of", "is_time", "ros_fields"]

CODES = {
    "bool": "?",
    "byte": "B",
    "char": "B",
    "uint8": "B",
    "int8": "b",
    "uint16": "H",
    "int16": "h",
    "uint32": "I",
    "int32": "i",
    "uint64": "Q",
    "int64": "q",
    "float32": "f",
    "float64": "d",
}
"""The code of each number of ROS in `struct` and `array`."""

TIMES = {
    "time": "II",
    "duration": "ii",
    "builtin_interfaces/Time": "iI",
    "builtin_interfaces/Duration": "iI",
}
"""The codes of a time's two numbers, by its name in ROS 1 and in ROS 2."""

HEADER = "std_msgs/Header"
"""The one type that ROS 1 and ROS 2 make of different fields: the count of messages, `seq`, is ROS 1's alone."""

_ROSTYPE = re.compile(r"(?P<base>[\w/]+)(?:<=\d+)?(?P<array>\[(?:<=)?(?P<length>\d*)\])?")
_DERIVED: dict[Any, str] = {
    float: "float64",
    int: "int64",
    bool: "bool",
    str: "string",
    bytes: "uint8[]",
    Float32Array: "float32[]",
    Float64Array: "float64[]",
    Int8Array: "int8[]",
}


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a message class."""

    name: str
    key: str
    """Name on the wire."""
    hint: Any
    """Type in Python."""
    rostype: str
    """Exact ROS type, as in `float64[36]`."""
    base: str
    """The ROS type of one element: `float64`, `string`, `geometry_msgs/Pose`, `time`."""
    array: bool
    """Whether it holds several elements."""
    length: int | None
    """Number of elements, where the type fixes it."""
    type: type[Msg] | None
    """The class of one element where that is a message."""


@functools.lru_cache(maxsize=1024)
def fields_of(cls: type[Msg]) -> tuple[Field, ...]:
    """The fields of `cls` in their order, without those for reading only (ROS 2's names in `Time`)."""
    known = [field for field in msgspec.structs.fields(cls) if not _optional(field.type)]
    told: tuple[str, ...] | None = getattr(cls, "ROSTYPES", None)
    if told is None:
        told = tuple(_derived(field.type) for field in known)
    if len(told) != len(known):
        raise ProtocolError(
            f"{cls.MSGTYPE or cls.__name__} has {len(known)} fields and {len(told)} ROS types."
        )
    return tuple(_field(field, rostype) for field, rostype in zip(known, told, strict=True))


@functools.lru_cache(maxsize=1024)
def ros_fields(cls: type[Msg], ros2: bool) -> tuple[Field, ...]:
    """The fields of `cls` as ROS 1 has them in their order, or as ROS 2 has them."""
    fields = fields_of(cls)
    if cls.MSGTYPE != HEADER:
        return fields
    count = () if ros2 else tuple(field for field in fields if field.key == "seq")
    return (*count, *[field for field in fields if field.key != "seq"])


def is_time(cls: type[Msg] | None) -> bool:
    """Whether `cls` is an instant or a length of time, whose fields ROS 1 and ROS 2 name differently."""
    return cls is not None and issubclass(cls, Time)


def bare(hint: Any) -> Any:
    """`hint` without its `Annotated` metadata."""
    return bare(typing.get_args(hint)[0]) if typing.get_origin(hint) is typing.Annotated else hint


def _field(field: msgspec.structs.FieldInfo, rostype: str) -> Field:
    found = _ROSTYPE.fullmatch(rostype)
    if found is None:
        raise ProtocolError(f"{field.name} has the type {rostype!r}, which is none of ROS.")
    length = int(found["length"]) if found["length"] and "<=" not in found["array"] else None
    return Field(
        name=field.name,
        key=field.encode_name,
        hint=field.type,
        rostype=rostype,
        base=found["base"],
        array=bool(found["array"]),
        length=length,
        type=_element(field.type),
    )


def _element(hint: Any) -> type[Msg] | None:
    hint = bare(hint)
    if typing.get_origin(hint) is list:
        return _element(typing.get_args(hint)[0])
    return hint if isinstance(hint, type) and issubclass(hint, Msg) else None


def _optional(hint: Any) -> bool:
    return typing.get_origin(bare(hint)) in (typing.Union, types.UnionType)


def _derived(hint: Any) -> str:
    """The ROS type of a field whose class does not have it; the widest number is taken."""
    hint = bare(hint)
    if hint in _DERIVED:
        return _DERIVED[hint]
    if typing.get_origin(hint) is list:
        return f"{_derived(typing.get_args(hint)[0])}[]"
    return str(hint.MSGTYPE or hint.__name__)
