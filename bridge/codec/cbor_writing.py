"""Writers of CBOR, made once for each message class, that visit each value of a message once.

The names and heads of its parts are prepared as the bytes that go before each of its values.
"""

from __future__ import annotations

import functools
import struct
import sys
from array import array
from collections.abc import Callable, Iterator
from operator import attrgetter
from typing import Any

import cbor2

from bridge.codec.fields import CODES, Field, bare, is_time, ros_fields
from bridge.codec.stamps import ROS2_NAMES
from bridge.msgs import Msg

__all__ = ["ARRAY", "MAP", "TAGS", "Writer", "head", "little", "message_writer"]

TAGS = {"B": 64, "H": 69, "I": 70, "Q": 71, "b": 72, "h": 77, "i": 78, "q": 79, "f": 85, "d": 86}
"""RFC 8746 tags of little-endian arrays by the type codes of `array.array`."""
UNSIGNED, NEGATIVE, BYTES, TEXT, ARRAY, MAP, TAG = range(0, 7 << 5, 1 << 5)
"""The first byte of a value says of which kind it is, in its upper three bits."""
_DOUBLE = b"\xfb"
_HEAD_2, _HEAD_4, _HEAD_8 = (struct.Struct(f">B{code}").pack for code in "HIQ")
"""A head whose number takes 2, 4 or 8 bytes."""

Writer = Callable[[Any], bytes]
"""Returns a value as CBOR. Raises TypeError, AttributeError, OverflowError, struct.error or UnicodeEncodeError for a
value of another kind."""


@functools.lru_cache(maxsize=1024)
def message_writer(cls: type[Msg], ros2: bool) -> Writer:
    """The writer of `cls`; with `ros2` times and headers are those of ROS 2. ProtocolError for a class that has no CBOR form."""
    before, paths, writers = b"", [], []
    for part in _parts(cls, "", ros2):
        if isinstance(part, bytes):
            before += part
        else:
            path, make = part
            paths.append(path)
            writers.append(make(before))
            before = b""
    return _joined(paths, writers, before)


def head(kind: int, number: int) -> bytes:
    """The first bytes of a value: its kind, and its value, length or tag; struct.error above 64 bits."""
    if number < 24:
        return bytes((kind | number,))
    if number < 1 << 8:
        return bytes((kind | 24, number))
    if number < 1 << 16:
        return _HEAD_2(kind | 25, number)
    if number < 1 << 32:
        return _HEAD_4(kind | 26, number)
    return _HEAD_8(kind | 27, number)


def _parts(
    cls: type[Msg], prefix: str, ros2: bool
) -> Iterator[bytes | tuple[str, Callable[[bytes], Writer]]]:
    """The constant bytes of a `cls`, and for each value its path and the maker of its writer from the bytes before it."""
    fields = ros_fields(cls, ros2)
    names = ROS2_NAMES if ros2 and is_time(cls) else {}
    yield head(MAP, len(fields))
    for field in fields:
        yield cbor2.dumps(names.get(field.key, field.key))
        path = f"{prefix}{field.name}"
        if field.type is not None and not field.array:
            yield from _parts(field.type, f"{path}.", ros2)
        else:
            yield path, _maker(field, ros2)


def _joined(paths: list[str], writers: list[Writer], end: bytes) -> Writer:
    if not paths:
        return lambda _: end
    get = attrgetter(*paths)
    if len(paths) == 1:
        (write,) = writers
        return lambda msg: write(get(msg)) + end
    return lambda msg: b"".join([write(value) for write, value in zip(writers, get(msg), strict=True)]) + end


def _maker(field: Field, ros2: bool) -> Callable[[bytes], Writer]:
    """The maker of the writer of a field's value."""
    if field.type is not None:
        return functools.partial(_several, message_writer(field.type, ros2))
    if field.array and field.base == "string":
        return functools.partial(_several, _text(b""))
    code = CODES.get(field.base)
    if field.array and code in TAGS and bare(field.hint) is not bytes:
        return functools.partial(_numbers, code)
    return _SIMPLE.get(bare(field.hint), _anything)


def _float(before: bytes) -> Writer:
    return functools.partial(struct.Struct(f">{len(before) + 1}sd").pack, before + _DOUBLE)


def _whole(before: bytes) -> Writer:
    return lambda value: before + (head(UNSIGNED, value) if value >= 0 else head(NEGATIVE, -1 - value))


def _text(before: bytes) -> Writer:
    def write(value: str) -> bytes:
        text = value.encode()
        return before + head(TEXT, len(text)) + text

    return write


def _bytes(before: bytes) -> Writer:
    return lambda value: b"".join((before, head(BYTES, len(value)), value))


def _anything(before: bytes) -> Writer:
    return lambda value: before + cbor2.dumps(value)


def _numbers(code: str, before: bytes) -> Writer:
    """A number array, of the field's own width where the message keeps a list."""

    def write(values: Any) -> bytes:
        if isinstance(values, array):
            data = little(values).tobytes()
            return b"".join((before, _array_head(values.typecode, len(data)), data))
        data = struct.pack(f"<{len(values)}{code}", *values)
        beginning = head(BYTES, len(data)) if code == "B" else _array_head(code, len(data))
        return b"".join((before, beginning, data))

    return write


def _several(write: Writer, before: bytes) -> Writer:
    return lambda values: b"".join((before, head(ARRAY, len(values)), *map(write, values)))


@functools.lru_cache(maxsize=256)
def _array_head(code: str, size: int) -> bytes:
    """Tag and head of a typed array of `size` bytes."""
    if code not in TAGS:
        raise TypeError(f"an array of {code!r} has no CBOR form")
    return head(TAG, TAGS[code]) + head(BYTES, size)


def little(values: array[Any]) -> array[Any]:
    """`values` with their bytes in the order of RFC 8746's little-endian arrays."""
    if sys.byteorder == "big":
        values = values[:]
        values.byteswap()
    return values


_SIMPLE: dict[Any, Callable[[bytes], Writer]] = {float: _float, int: _whole, str: _text, bytes: _bytes}
