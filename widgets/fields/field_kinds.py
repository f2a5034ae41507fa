"""Fields of a message type that one figure, lamp or word can show, with their units and the names of their values. No Kivy.

for field in plain_fields(Odometry):
    print(field.path, field.kind, field.unit)      # twist.twist.linear.x number m/s
"""

from __future__ import annotations

import math
import typing
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Any

from bridge.msgs import Msg
from widgets.fields.message_fields import spelled

__all__ = [
    "ENUM",
    "MAX_DEPTH",
    "MAX_FIELDS",
    "NUMBER",
    "TEXT",
    "TRUTH",
    "PlainField",
    "enum_names",
    "plain_fields",
]

NUMBER, TRUTH, ENUM, TEXT = "number", "truth", "enum", "text"
"""Kinds of fields: a quantity or count, a bool, a number whose values have names, a string."""
MAX_FIELDS = 60
"""Fields of one type that are listed; a longer one is read as a tree."""
MAX_DEPTH = 6
"""Messages inside messages that are looked into."""
_LEFT_OUT = ("std_msgs/Header",)
"""Types whose fields tell of the message and not of the robot."""
_UNCERTAINTY = ("variance",)
"""Words in the names of fields that tell how well others are known."""
_TURNS = ("yaw", "pitch", "roll")
"""Angles of a quaternion by which people read it."""
_DEGREES = {"rad": ("°", 1), "rad/s": ("°/s", 1), "rad/s2": ("°/s²", 1)}
"""Unit of an angle to the unit and the decimals in which people read it; an angle that is told in degrees is of a place."""
_DECIMALS = {"m": 2, "m/s": 2, "m/s²": 2, "%": 0, "pixel": 0, "°": 6}
_FLOATS = ("float32", "float64")


@dataclass(frozen=True, slots=True)
class PlainField:
    """One field of a message type."""

    path: str
    """Way to it from the message, as in `twist.twist.linear.x`."""
    kind: str
    """`NUMBER`, `TRUTH`, `ENUM` or `TEXT`."""
    unit: str = ""
    """In which people read it; empty where it is not known or there is none."""
    factor: float = 1.0
    """What the field is multiplied by to be in `unit`."""
    digits: int = 0
    """Decimals that are worth reading."""
    names: Mapping[int, str] = field(default_factory=lambda: MappingProxyType({}))
    """Of an `ENUM`: value to its name in words."""

    @property
    def title(self) -> str:
        """What it is called where it stands alone, as in `Linear x` or `Cell voltage`; empty for a field `data`."""
        parts = [part for part in self.path.split(".") if part not in ("data", "pose", "twist")]
        short = len(parts[-1]) <= 1 or parts[-1] in _TURNS if parts else False
        words = " ".join(parts[-2:] if short else parts[-1:]).replace("_", " ")
        return words[:1].upper() + words[1:]


@lru_cache(maxsize=512)
def plain_fields(kind: type[Msg]) -> tuple[PlainField, ...]:
    """The fields of a type that stand for themselves, in their order; of a quaternion its angles.

    Lists, times and headers have none. At most 60 are given.
    """
    found: list[PlainField] = []
    for one in _walk(kind, "", "", 0):
        found.append(one)
        if len(found) == MAX_FIELDS:
            break
    return tuple(found)


def _walk(kind: type[Msg], way: str, outer: str, depth: int) -> Iterator[PlainField]:
    names: tuple[str, ...] = kind.__struct_fields__
    types: tuple[str, ...] = getattr(kind, "ROSTYPES", ())
    if kind.MSGTYPE in _LEFT_OUT or len(types) != len(names) or depth > MAX_DEPTH:
        return
    if kind.MSGTYPE == "geometry_msgs/Quaternion":
        yield from (_number(f"{way}{turn}", "rad", "float64") for turn in _TURNS if hasattr(kind, turn))
        return
    told = getattr(kind, "UNITS", None)
    units: Mapping[str, str] = told if isinstance(told, dict) else {}
    parts = _parts(kind)
    for name, rostype in zip(names, types, strict=True):
        if any(word in name for word in _UNCERTAINTY):
            continue
        path, unit = f"{way}{name}", units.get(name, "") or outer
        inner = parts.get(name)
        if inner is not None:
            yield from _walk(inner, f"{path}.", unit, depth + 1)
        elif rostype in ("bool", "string", "wstring"):
            yield PlainField(path, TRUTH if rostype == "bool" else TEXT)
        elif _is_number(rostype):
            values = enum_names(kind, name) if rostype not in _FLOATS else {}
            yield (
                PlainField(path, ENUM, names=MappingProxyType(values))
                if values
                else _number(path, unit, rostype)
            )


@lru_cache(maxsize=512)
def _parts(kind: type[Msg]) -> dict[str, type[Msg]]:
    """The fields of a type that are messages themselves, but times."""
    hints: dict[str, Any] = typing.get_type_hints(kind)
    found = {name: hints.get(name) for name in kind.__struct_fields__}
    return {
        name: one
        for name, one in found.items()
        if isinstance(one, type) and issubclass(one, Msg) and hasattr(one, "ROSTYPES")
    }


def _is_number(rostype: str) -> bool:
    return rostype in (*_FLOATS, "byte", "char") or (
        rostype.removeprefix("u").startswith("int") and rostype.removeprefix("u")[3:].isdigit()
    )


def _number(path: str, unit: str, rostype: str) -> PlainField:
    if unit in _DEGREES:
        shown, digits = _DEGREES[unit]
        return PlainField(path, NUMBER, shown, math.degrees(1.0), digits)
    shown = spelled(unit)
    digits = _DECIMALS.get(shown, 2) if rostype in _FLOATS else 0
    return PlainField(path, NUMBER, shown, 1.0, digits)


def enum_names(kind: type[Msg], name: str) -> dict[int, str]:
    """Value to name in words of the constants that a message type has for its field `name`; empty when it has none.

    `STATUS_FIX` belongs to `status`; constants without such a prefix belong to the only whole number of their type.
    """
    constants = _constants(kind)
    prefix = f"{name.upper()}_"
    own = {key: value for key, value in constants.items() if key.startswith(prefix)}
    if not own:
        prefix = ""
        own = _free_constants(kind, name, constants)
    values = list(own.values())
    if len(values) < 2 or len(set(values)) != len(values):
        return {}
    return {value: _words(key.removeprefix(prefix)) for key, value in own.items()}


def _free_constants(kind: type[Msg], name: str, constants: Mapping[str, int]) -> dict[str, int]:
    """Constants that no field's name begins, where `name` is the only whole number that they can be of."""
    whole = [
        one
        for one, rostype in zip(kind.__struct_fields__, kind.ROSTYPES, strict=True)
        if _is_number(rostype) and rostype not in _FLOATS
    ]
    if whole != [name]:
        return {}
    others = tuple(f"{one.upper()}_" for one in kind.__struct_fields__)
    return {key: value for key, value in constants.items() if not key.startswith(others)}


def _constants(kind: type[Msg]) -> dict[str, int]:
    """Whole constants of a type, in their order."""
    own = ("MSGTYPE", "ROSTYPES", "CONSTTYPES", "UNITS")
    return {
        key: value
        for key, value in vars(kind).items()
        if key.isupper() and key not in own and isinstance(value, int) and not isinstance(value, bool)
    }


def _words(constant: str) -> str:
    """`NOT_CHARGING` as `not charging`."""
    return constant.replace("_", " ").strip().lower()
