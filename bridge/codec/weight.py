"""Approximate memory of messages, for bounds on queues and latched messages."""

from __future__ import annotations

import functools
import typing
from array import array
from typing import Any

import msgspec

from bridge.msgs import Msg

__all__ = ["weight"]

_VALUE = 32
"""Memory of a number, a record or a place in a list [byte]."""
_NUMBERS = (float, int)  # bool is one of them


def weight(msg: Msg) -> int:
    """Approximate memory of `msg` [byte]."""
    fixed, others = _parts(type(msg))
    return fixed + sum(_of(getattr(msg, name)) for name in others)


def _of(value: Any) -> int:
    if isinstance(value, (str, bytes)):
        return _VALUE + len(value)
    if isinstance(value, Msg):
        return weight(value)
    if isinstance(value, array):
        return _VALUE + len(value) * value.itemsize
    if isinstance(value, list):
        inner = 0 if value and isinstance(value[0], _NUMBERS) else sum(map(_of, value))
        return _VALUE * (len(value) + 1) + inner
    return _VALUE


@functools.lru_cache(maxsize=4096)
def _parts(cls: type[Msg]) -> tuple[int, tuple[str, ...]]:
    """The memory that all messages of a class take, and the names of the fields that take more in some."""
    fixed, others = _VALUE, []
    for field in msgspec.structs.fields(cls):
        hint = field.type
        while typing.get_origin(hint) is typing.Annotated:
            hint = typing.get_args(hint)[0]
        inner = _parts(hint) if isinstance(hint, type) and issubclass(hint, Msg) else None
        if hint in _NUMBERS or hint is bool:
            fixed += _VALUE
        elif inner is not None and not inner[1]:
            fixed += inner[0]
        else:
            others.append(field.name)
    return fixed, tuple(others)
