"""Messages to CBOR (RFC 8949) and back, number arrays as typed arrays (RFC 8746)."""

from __future__ import annotations

import functools
import struct
import sys
from array import array
from collections.abc import Callable
from typing import Any

import cbor2
import msgspec

from bridge.codec.fields import CODES, Field, fields_of, is_time
from bridge.codec.stamps import renamer
from bridge.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.arrays import ARRAYS

__all__ = ["from_cbor", "to_cbor"]

_CODES = {64: "B", 69: "H", 70: "I", 71: "Q", 72: "b", 77: "h", 78: "i", 79: "q", 85: "f", 86: "d"}
"""RFC 8746 tags of little-endian arrays and the matching type codes of `array.array`."""
_TAGS = {code: tag for tag, code in _CODES.items()}
_BUILTIN = (bytes, cbor2.CBORTag)
Packer = Callable[[dict[str, Any]], None]
"""Puts what CBOR says better into a message's dict, in place."""


def to_cbor(obj: object, ros2: bool = False) -> bytes:
    """A message, or a structure of plain values that may hold messages, as CBOR; ProtocolError when it has no such form.

    Every number array is a typed array of its field's width, whether the class keeps a list or an array; with `ros2` times
    have ROS 2's names.
    """
    try:
        return cbor2.dumps(_plain(obj, ros2))
    except (cbor2.CBORError, OverflowError, UnicodeEncodeError, TypeError, struct.error) as error:
        raise ProtocolError(f"This cannot be sent as CBOR: {error}.") from error


def from_cbor(raw: bytes) -> Any:
    """What a CBOR text holds, number arrays as `array.array`; ProtocolError when it is not CBOR."""
    try:
        return cbor2.loads(raw, tag_hook=_cbor_tag)
    except Exception as error:  # CBOR tags name dates, patterns, addresses: their makers raise what they like
        raise ProtocolError(f"{len(raw)} bytes that are not CBOR ({error}).") from error


def _plain(obj: object, ros2: bool) -> object:
    if isinstance(obj, Msg):
        return _plain_message(obj, ros2)
    if isinstance(obj, dict):
        return {key: _plain(value, ros2) for key, value in obj.items()}
    if isinstance(obj, (list, tuple)):
        return [_plain(value, ros2) for value in obj]
    return msgspec.to_builtins(obj, builtin_types=_BUILTIN, enc_hook=_tagged)


def _plain_message(msg: Msg, ros2: bool) -> dict[str, Any]:
    found: dict[str, Any] = msgspec.to_builtins(msg, builtin_types=_BUILTIN, enc_hook=_tagged)
    if pack := _packer(type(msg)):
        pack(found)
    if ros2 and (rename := renamer(type(msg))):
        rename(found)
    return found


@functools.lru_cache(maxsize=1024)
def _packer(cls: type[Msg]) -> Packer | None:
    """What makes typed arrays of a `cls`'s lists of numbers; None when it has none."""
    works = [work for field in fields_of(cls) if not is_time(field.type) and (work := _work(field))]
    if not works:
        return None

    def pack(obj: dict[str, Any]) -> None:
        for work in works:
            work(obj)

    return pack


def _work(field: Field) -> Packer | None:
    if field.type is not None:
        inner = _packer(field.type)
        return functools.partial(_pack_inner, field.key, field.array, inner) if inner else None
    code = CODES.get(field.base)
    if not field.array or code not in _TAGS:
        return None
    return functools.partial(_pack_list, field.key, code, _TAGS[code])


def _pack_inner(key: str, several: bool, inner: Packer, obj: dict[str, Any]) -> None:
    for each in obj[key] if several else (obj[key],):
        inner(each)


def _pack_list(key: str, code: str, tag: int, obj: dict[str, Any]) -> None:
    values = obj[key]
    if isinstance(values, list):
        data = struct.pack(f"<{len(values)}{code}", *values)
        obj[key] = data if code == "B" else cbor2.CBORTag(tag, data)


def _tagged(obj: object) -> cbor2.CBORTag:
    if isinstance(obj, array) and obj.typecode in _TAGS:
        return cbor2.CBORTag(_TAGS[obj.typecode], _little(obj).tobytes())
    raise TypeError(f"{obj.__class__.__name__} has no CBOR form")


def _cbor_tag(*told: Any) -> object:
    tag = next(
        each for each in told if isinstance(each, cbor2.CBORTag)
    )  # cbor2 5 tells it last, cbor2 6 first
    code = _CODES.get(tag.tag)
    if code is None or not isinstance(tag.value, bytes):
        return tag
    cls = ARRAYS.get(tag.tag)
    return _little(cls(tag.value) if cls else array(code, tag.value))


def _little(values: array[Any]) -> array[Any]:
    if sys.byteorder == "big":
        values = values[:]
        values.byteswap()
    return values
