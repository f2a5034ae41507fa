"""Messages to ROS's binary formats."""

from __future__ import annotations

import functools
import struct
import sys
from array import array
from collections.abc import Callable, Iterator, Sequence
from operator import attrgetter
from typing import Any

from bridge.codec.fields import CODES, Field, is_time
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.rosbytes.layout import CDR_LITTLE_ENDIAN, fields_with_widths, lacks_count, time_codes

__all__ = ["serialize"]

_U32 = struct.Struct("<I")
Step = Callable[[bytearray, Any], None]
"""Writes one part of a message."""
Elements = Callable[[bytearray, Any], None]
"""Writes the elements of an array."""


def serialize(msg: Msg, cdr: bool = False) -> bytes:
    """`msg` as ROS 1 would send it, or with `cdr` as ROS 2 would.

    ProtocolError for a class that does not have its ROS types, and for a value that its field cannot hold.
    """
    out = bytearray()
    try:
        for step in _steps(type(msg), cdr):
            step(out, msg)
    except (struct.error, OverflowError, TypeError, UnicodeEncodeError) as error:
        raise ProtocolError(f"{msg.MSGTYPE} cannot be sent as bytes of ROS: {error}.") from error
    return CDR_LITTLE_ENDIAN + out if cdr else bytes(out)


@functools.lru_cache(maxsize=512)
def _steps(cls: type[Msg], cdr: bool) -> tuple[Step, ...]:
    """The writers of a `cls`; consecutive numbers, however deeply nested, are one step."""
    steps: list[Step] = []
    run: list[tuple[str, str]] = []
    for part in _parts(cls, "", cdr):
        if isinstance(part, tuple):
            run.append(part)
            continue
        if run:
            steps.append(_numbers(run, cdr))
            run = []
        steps.append(part)
    if run:
        steps.append(_numbers(run, cdr))
    return tuple(steps)


def _parts(cls: type[Msg], prefix: str, cdr: bool) -> Iterator[tuple[str, str] | Step]:
    """Path and code of each number, and a step for each part of variable length."""
    if is_time(cls):
        yield from zip((f"{prefix}secs", f"{prefix}nsecs"), time_codes(cls, cdr), strict=True)
        return
    fields = fields_with_widths(cls, cdr)
    if cdr and not fields:
        yield "", "x"  # IDL knows no empty structure: ROS 2 puts one byte there
    if lacks_count(cls, cdr):
        yield "", "4x"
    for field in fields:
        yield from _field(field, f"{prefix}{field.name}", cdr)


def _field(field: Field, path: str, cdr: bool) -> Iterator[tuple[str, str] | Step]:
    code = CODES.get(field.base)
    if field.type is not None and not field.array:
        yield from _parts(field.type, f"{path}.", cdr)
    elif code is not None and not field.array:
        yield path, code
    elif field.type is not None:
        yield _several(field, path, cdr, _messages(field.type, cdr))
    elif field.base == "string":
        yield _several(field, path, cdr, _texts(cdr)) if field.array else _text(path, cdr)
    elif code is not None:
        yield _several(field, path, cdr, _array(code, cdr))
    else:
        raise ProtocolError(f"{path} is a {field.rostype}, which has no form in bytes of ROS here.")


def _numbers(run: list[tuple[str, str]], cdr: bool) -> Step:
    paths = [path for path, _ in run if path]
    codes = [code for _, code in run]
    get = attrgetter(*paths) if paths else None
    packs = [struct.Struct(_format(codes, start, cdr)).pack for start in range(8 if cdr else 1)]
    single = len(paths) == 1

    def write(out: bytearray, msg: Any) -> None:
        pack = packs[len(out) & 7 if cdr else 0]
        if get is None:
            out += pack()
        elif single:
            out += pack(get(msg))
        else:
            out += pack(*get(msg))

    return write


def _format(codes: list[str], start: int, cdr: bool) -> str:
    """The `struct` format of numbers that begin at `start` [byte]; in CDR each at a multiple of its size."""
    whole, place = "<", start
    for code in codes:
        size = struct.calcsize(f"<{code}")
        gap = -place % size if cdr else 0
        whole += f"{gap}x{code}" if gap else code
        place += gap + size
    return whole


def _align(out: bytearray, size: int) -> None:
    out += bytes(-len(out) % size)


def _count(out: bytearray, number: int, cdr: bool) -> None:
    if cdr:
        _align(out, 4)
    out += _U32.pack(number)


def _text(path: str, cdr: bool) -> Step:
    get, write = attrgetter(path), _texts(cdr)
    return lambda out, msg: write(out, (get(msg),))


def _texts(cdr: bool) -> Elements:
    def write(out: bytearray, texts: Sequence[str]) -> None:
        for text in texts:
            raw = text.encode() + b"\0" if cdr else text.encode()
            _count(out, len(raw), cdr)
            out += raw

    return write


def _messages(cls: type[Msg], cdr: bool) -> Elements:
    steps = _steps(cls, cdr)

    def write(out: bytearray, msgs: Sequence[Msg]) -> None:
        for msg in msgs:
            for step in steps:
                step(out, msg)

    return write


def _array(code: str, cdr: bool) -> Elements:
    size = struct.calcsize(f"<{code}")

    def write(out: bytearray, values: Any) -> None:
        if cdr and len(values):
            _align(out, size)
        if isinstance(values, bytes) and size == 1:
            out += values
        elif isinstance(values, array) and values.typecode == code and sys.byteorder == "little":
            out += values.tobytes()
        else:
            out += struct.pack(f"<{len(values)}{code}", *values)

    return write


def _several(field: Field, path: str, cdr: bool, elements: Elements) -> Step:
    """The writer of an array: its length, unless the type fixes it, and then each element."""
    get, length = attrgetter(path), field.length

    def write(out: bytearray, msg: Any) -> None:
        values = get(msg)
        if length is None:
            _count(out, len(values), cdr)
        elif len(values) != length:
            raise ProtocolError(f"{path} must hold {length}, not {len(values)}.")
        elements(out, values)

    return write
