"""Messages from ROS's binary formats."""

from __future__ import annotations

import functools
import struct
import sys
from array import array
from collections.abc import Callable
from typing import Any, TypeVar, cast

from bridge.codec.fields import CODES, Field, bare, is_time
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.rosbytes.layout import CDR_LITTLE_ENDIAN, fields_with_widths, lacks_count, time_codes

__all__ = ["deserialize"]

M = TypeVar("M", bound=Msg)


class _Cursor:
    """A position in the bytes of one message."""

    __slots__ = ("cdr", "place", "raw")

    def __init__(self, raw: bytes, cdr: bool) -> None:
        self.raw = raw
        self.cdr = cdr
        self.place = 0

    def read(self, size: int) -> bytes:
        """The next `size` bytes."""
        begin, self.place = self.place, self.place + size
        if self.place > len(self.raw):
            raise ProtocolError(f"it ends after {len(self.raw)} bytes, where {self.place} are needed")
        return self.raw[begin : self.place]

    def align(self, size: int) -> None:
        """In CDR, advance to a multiple of `size`."""
        if self.cdr:
            self.place += -self.place % size

    def number(self, code: str) -> Any:
        """The next number."""
        size = struct.calcsize(f"<{code}")
        self.align(size)
        return struct.unpack(f"<{code}", self.read(size))[0]

    def count(self) -> int:
        """The number of elements that follow; ProtocolError for more than there are bytes."""
        found: int = self.number("I")
        if found > len(self.raw):
            raise ProtocolError(f"{found} elements cannot stand in {len(self.raw)} bytes")
        return found


Read = Callable[[_Cursor], Any]


def deserialize(raw: bytes, type: type[M], cdr: bool = False) -> M:
    """The `type` in bytes as ROS 1 sends them, or with `cdr` as ROS 2 does.

    ProtocolError when they are none, and for a class that does not have its ROS types.
    """
    if cdr and raw[:2] != CDR_LITTLE_ENDIAN[:2]:
        raise ProtocolError(f"{type.MSGTYPE} is not in little-endian CDR: it begins with {raw[:4]!r}.")
    cursor = _Cursor(raw[4:] if cdr else raw, cdr)
    read = _message(type, cdr)
    try:
        found = read(cursor)
    except (struct.error, ValueError, ProtocolError) as error:
        raise ProtocolError(f"{len(raw)} bytes that are no {type.MSGTYPE}: {error}.") from error
    if len(cursor.raw) - cursor.place > (3 if cdr else 0):  # CDR may end in padding
        raise ProtocolError(f"{len(raw)} bytes that are no {type.MSGTYPE}: {cursor.place} would be enough.")
    return cast(M, found)


@functools.lru_cache(maxsize=512)
def _message(cls: type[Msg], cdr: bool) -> Read:
    if is_time(cls):
        codes = time_codes(cls, cdr)
        return lambda cursor: cls(*[cursor.number(code) for code in codes])
    fields = fields_with_widths(cls, cdr)
    reads = [(field.name, _field(field, cdr)) for field in fields]
    # Of what the class leaves out: ROS 1's count in a header, and the byte of an empty structure in CDR.
    ahead = 4 if lacks_count(cls, cdr) else 1 if cdr and not fields else 0

    def read(cursor: _Cursor) -> Msg:
        cursor.read(ahead)
        return cls(**{name: each(cursor) for name, each in reads})

    return read


def _field(field: Field, cdr: bool) -> Read:
    code = CODES.get(field.base)
    if field.type is not None:
        one = _message(field.type, cdr)
    elif field.base == "string":
        one = _text
    elif code is None:
        raise ProtocolError(f"{field.name} is a {field.rostype}, which has no form in bytes of ROS here.")
    elif field.array:
        return _numbers(field, code)
    else:
        return lambda cursor: cursor.number(code)
    if not field.array:
        return one
    return lambda cursor: [one(cursor) for _ in range(_length(field, cursor))]


def _length(field: Field, cursor: _Cursor) -> int:
    return cursor.count() if field.length is None else field.length


def _text(cursor: _Cursor) -> str:
    raw = cursor.read(cursor.count())
    return (raw[:-1] if cursor.cdr else raw).decode()


def _numbers(field: Field, code: str) -> Read:
    """An array of numbers, as its class keeps it: bytes, a typed array or a list."""
    size = struct.calcsize(f"<{code}")
    kind: Any = bare(field.hint)
    typed = isinstance(kind, type) and issubclass(kind, array)

    def read(cursor: _Cursor) -> Any:
        number = _length(field, cursor)
        if number:
            cursor.align(size)
        raw = cursor.read(number * size)
        if kind is bytes:
            return raw
        if typed and sys.byteorder == "little":
            return kind(raw)
        found = list(struct.unpack(f"<{number}{code}", raw))
        return kind(found) if typed else found

    return read
