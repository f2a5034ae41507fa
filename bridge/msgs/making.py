"""Message classes made at run time, of their fields and constants."""

from __future__ import annotations

import functools
import keyword
import typing
from collections.abc import Callable
from typing import Annotated, Any

import msgspec
from msgspec import Meta

from bridge.msgs import base
from bridge.msgs.arrays import ARRAYS
from bridge.msgs.base import Msg
from bridge.msgs.builtin_interfaces import Duration, Time

__all__ = ["BUILT_IN", "SCALARS", "Constant", "FieldOf", "make_class", "rostype"]

FieldOf = tuple[str, tuple[str, int], type[Msg] | None]
"""Name of a field, the ROS type of one element with the array's length (-1 for none, 0 for any), and the element's class
where that is a message."""
Constant = tuple[str, bool | int | float | str]
"""Name and value."""

SCALARS: dict[str, Any] = {
    "bool": bool,
    "string": str,
    "wstring": str,
    "float32": float,
    "float64": float,
    "char": base.char,
    "byte": base.byte,
    **{
        f"{sign}int{bits}": getattr(base, f"{sign}int{bits}")
        for sign in ("", "u")
        for bits in (8, 16, 32, 64)
    },
}
"""The annotation of each basic type."""
BUILT_IN: dict[str, type[Msg]] = {"time": Time, "duration": Duration}
"""The classes of the two types that are built into ROS 1."""
_ZEROS: dict[Any, Any] = {"bool": False, "string": "", "wstring": "", "float32": 0.0, "float64": 0.0}
_BYTES = ("uint8", "char", "byte")
_NAMES_OF_CODES = {
    "f": "float32",
    "d": "float64",
    "b": "int8",
    "h": "int16",
    "i": "int32",
    "q": "int64",
    "H": "uint16",
    "I": "uint32",
    "Q": "uint64",
}
_ARRAY_OF = {_NAMES_OF_CODES[cls.code]: cls for cls in ARRAYS.values()}
_RESERVED = ("ROSTYPES", "CONSTTYPES")


@functools.lru_cache(maxsize=1024)
def make_class(
    name: str,
    fields: tuple[FieldOf, ...],
    constants: tuple[Constant, ...],
    constant_types: tuple[str, ...] = (),
    source: str = "",
) -> type[Msg]:
    """The class called `name`, as in `boat_msgs/Boat`; the same arguments give the same class.

    `constant_types` has the ROS type of each constant, if known; `source` is the last part of its docstring.
    """
    namespace = dict(constants) | {
        "MSGTYPE": name,
        "ROSTYPES": tuple(rostype(*kind) for _, kind, _ in fields),
        "CONSTTYPES": constant_types,
        "__doc__": f"{name}, {source}",
    }
    parts = [_field(field, kind, length, inner) for field, (kind, length), inner in fields]
    called = name.partition("/")[2]
    made = msgspec.defstruct(
        called, parts, bases=(Msg,), namespace=namespace, module=__name__, frozen=True, gc=False
    )
    return typing.cast(type[Msg], made)


def rostype(kind: str, length: int) -> str:
    """The ROS type of a field, as in `float64[36]`."""
    return kind if length < 0 else f"{kind}[{length or ''}]"


def _field(name: str, kind: str, length: int, inner: type[Msg] | None) -> tuple[str, Any, Any]:
    attribute = f"{name}_" if keyword.iskeyword(name) or name in _RESERVED or hasattr(Msg, name) else name
    hint, default = _hint(kind, length, inner)
    renamed = name if attribute != name else None
    if callable(default):
        return attribute, hint, msgspec.field(default_factory=default, name=renamed)
    return attribute, hint, msgspec.field(default=default, name=renamed)


def _hint(kind: str, length: int, inner: type[Msg] | None) -> tuple[Any, Any]:
    """The annotation of a field and its default, or the factory of its default."""
    item: Any = SCALARS[kind] if inner is None else inner
    if length < 0:
        return item, inner if inner is not None else _ZEROS.get(kind, 0)
    size = Meta(min_length=length, max_length=length)
    if kind in _BYTES:
        return (Annotated[bytes, size] if length else bytes), bytes(length)
    if not length:
        return (_ARRAY_OF[kind],) * 2 if kind in _ARRAY_OF else (list[item], list)
    return Annotated[list[item], size], _filled(kind, length, inner)


def _filled(kind: str, length: int, inner: type[Msg] | None) -> Callable[[], list[Any]]:
    if inner is not None:
        return lambda: [inner() for _ in range(length)]
    zero = _ZEROS.get(kind, 0)
    return lambda: [zero] * length
