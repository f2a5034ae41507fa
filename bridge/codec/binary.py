"""Messages to CBOR (RFC 8949) and back, number arrays as typed arrays (RFC 8746)."""

from __future__ import annotations

import struct
from array import array
from typing import Any

import cbor2
import msgspec

from bridge.codec.cbor_writing import ARRAY, MAP, TAGS, head, little, message_writer
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.arrays import ARRAYS

__all__ = ["from_cbor", "to_cbor"]

_CODES = {tag: code for code, tag in TAGS.items()}
_NOT_CBOR = (cbor2.CBORError, OverflowError, UnicodeEncodeError, TypeError, AttributeError, struct.error)


def to_cbor(obj: object, ros2: bool = False) -> bytes:
    """A message, or a structure of plain values that may hold messages, as CBOR; ProtocolError when it has no such form.

    Every number array is a typed array of its field's width, whether the class keeps a list or an array; with `ros2` times
    and headers are those of ROS 2.
    """
    try:
        return _written(obj, ros2)
    except _NOT_CBOR as error:
        raise ProtocolError(f"This cannot be sent as CBOR: {error}.") from error


def from_cbor(raw: bytes) -> Any:
    """What a CBOR text holds, number arrays as `array.array`; ProtocolError when it is not CBOR."""
    try:
        return cbor2.loads(raw, tag_hook=_cbor_tag)
    except Exception as error:  # CBOR tags name dates, patterns, addresses: their makers raise what they like
        raise ProtocolError(f"{len(raw)} bytes that are not CBOR ({error}).") from error


def _written(obj: object, ros2: bool) -> bytes:
    if isinstance(obj, Msg):
        return message_writer(type(obj), ros2)(obj)
    if isinstance(obj, dict):
        pairs = [cbor2.dumps(key) + _written(value, ros2) for key, value in obj.items()]
        return b"".join((head(MAP, len(pairs)), *pairs))
    if isinstance(obj, (list, tuple)):
        return b"".join((head(ARRAY, len(obj)), *[_written(value, ros2) for value in obj]))
    return cbor2.dumps(msgspec.to_builtins(obj, builtin_types=(bytes, cbor2.CBORTag), enc_hook=_tagged))


def _tagged(obj: object) -> cbor2.CBORTag:
    if isinstance(obj, array) and obj.typecode in TAGS:
        return cbor2.CBORTag(TAGS[obj.typecode], little(obj).tobytes())
    raise TypeError(f"{obj.__class__.__name__} has no CBOR form")


def _cbor_tag(*told: Any) -> object:
    tag = next(
        each for each in told if isinstance(each, cbor2.CBORTag)
    )  # cbor2 5 tells it last, cbor2 6 first
    code = _CODES.get(tag.tag)
    if code is None or not isinstance(tag.value, bytes):
        return tag
    cls = ARRAYS.get(tag.tag)
    return little(cls(tag.value) if cls else array(code, tag.value))
