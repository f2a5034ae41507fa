"""Messages to JSON and CBOR and back.

JSON has no NaN and no infinity: both travel as `null`, which comes back as NaN. `uint8[]` travels as base64.
In CBOR numbers keep their value, `uint8[]` is a byte string and number arrays are RFC 8746 typed arrays.
"""

from __future__ import annotations

import base64
import binascii
import functools
import math
import sys
import types
import typing
from array import array
from collections.abc import Callable
from typing import Any, TypeVar

import cbor2
import msgspec

from bridge.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.arrays import ARRAYS

__all__ = ["from_builtins", "from_cbor", "from_json", "shown", "to_builtins", "to_cbor", "to_json"]

M = TypeVar("M", bound=Msg)
Reader = Callable[[Any, str], Any]
"""Makes a field's value of what was decoded; the text is the field's path, for the error."""

_TYPED = tuple(ARRAYS.values())
_CBOR_TYPES = (bytes, cbor2.CBORTag)
_TAGS = {cls: tag for tag, cls in ARRAYS.items()}
_CODES = {64: "B", 69: "H", 70: "I", 71: "Q", 72: "b", 77: "h", 78: "i", 79: "q", 85: "f", 86: "d"}
"""RFC 8746 tags of little-endian arrays and the matching type codes of `array.array`."""
_HOLDS = {"b": "whole numbers from -128 to 127", "f": "numbers", "d": "numbers"}


def to_json(msg: Msg) -> bytes:
    """`msg` as JSON text in UTF-8; NaN and infinities become `null`. ProtocolError for what JSON cannot say."""
    try:
        return _ENCODER.encode(msg)
    except (UnicodeEncodeError, TypeError) as error:
        raise ProtocolError(f"{msg.MSGTYPE} cannot be sent: {error}.") from error


def from_json(raw: bytes | str | msgspec.Raw, type: type[M]) -> M:
    """The message in JSON text; missing fields take their defaults, `null` numbers become NaN.

    ProtocolError names the field, its value and what is allowed.
    """
    try:
        return typing.cast(M, _decoder(type).decode(raw))
    except (msgspec.MsgspecError, OverflowError, UnicodeError, RecursionError):
        return from_builtins(_loads(raw, type), type)


def to_builtins(msg: Msg) -> dict[str, Any]:
    """`msg` as dicts, lists and numbers; bytes and typed arrays stay what they are."""
    return typing.cast("dict[str, Any]", msgspec.to_builtins(msg, builtin_types=(bytes, *_TYPED)))


def from_builtins(obj: object, type: type[M]) -> M:
    """The message in decoded JSON or CBOR; same rules as `from_json`."""
    try:
        return typing.cast(M, _reader(type)(obj, ""))
    except RecursionError as error:
        raise ProtocolError(f"{type.MSGTYPE} is nested too deeply.") from error


def to_cbor(obj: object) -> bytes:
    """A message, or a structure of plain values that may hold messages, as CBOR."""
    try:
        return cbor2.dumps(msgspec.to_builtins(obj, builtin_types=_CBOR_TYPES, enc_hook=_tagged))
    except (cbor2.CBORError, OverflowError, UnicodeEncodeError, TypeError) as error:
        raise ProtocolError(f"This cannot be sent as CBOR: {error}.") from error


def from_cbor(raw: bytes) -> Any:
    """What a CBOR text holds, number arrays as `array.array`; ProtocolError when it is not CBOR."""
    try:
        return cbor2.loads(raw, tag_hook=_cbor_tag)
    except Exception as error:  # CBOR tags name dates, patterns, addresses: their makers raise what they like
        raise ProtocolError(f"{len(raw)} bytes that are not CBOR ({error}).") from error


def _enc_hook(obj: object) -> object:
    if isinstance(obj, array):
        return obj.tolist()
    raise TypeError(f"{obj!r} has no JSON form")


def _dec_hook(type: type[Any], obj: object) -> object:
    if not isinstance(obj, list):
        raise TypeError("not a list")
    return type(obj)


_ENCODER = msgspec.json.Encoder(enc_hook=_enc_hook)


@functools.cache
def _decoder(type: type[Msg]) -> msgspec.json.Decoder[Any]:
    return msgspec.json.Decoder(type, dec_hook=_dec_hook)


def _loads(raw: bytes | str | msgspec.Raw, type: type[Msg]) -> Any:
    try:
        return msgspec.json.decode(raw)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise ProtocolError(f"{type.MSGTYPE} is not JSON: {error}.") from error


def _tagged(obj: object) -> cbor2.CBORTag:
    if isinstance(obj, _TYPED):
        return cbor2.CBORTag(_TAGS[obj.__class__], _little(obj).tobytes())
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


@functools.cache
def _reader(hint: Any) -> Reader:
    if hint in _SCALARS:
        return _SCALARS[hint]
    if typing.get_origin(hint) is list:
        return _list_reader(_reader(typing.get_args(hint)[0]))
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return _reader(typing.get_args(hint)[0])
    if issubclass(hint, Msg):
        return _msg_reader(hint)
    return functools.partial(_read_array, hint)


def _msg_reader(type: type[Msg]) -> Reader:
    fields = {field.name: _reader(field.type) for field in msgspec.structs.fields(type)}

    def read(obj: Any, path: str) -> Msg:
        if isinstance(obj, type):
            return obj
        if not isinstance(obj, dict):
            raise _wrong(path or type.MSGTYPE, obj, "an object")
        prefix = f"{path}." if path else ""
        return type(
            **{name: reader(obj[name], f"{prefix}{name}") for name, reader in fields.items() if name in obj}
        )

    return read


def _list_reader(item: Reader) -> Reader:
    def read(obj: Any, path: str) -> list[Any]:
        if not isinstance(obj, (list, array)):
            raise _wrong(path, obj, "a list")
        return [item(value, f"{path}[{index}]") for index, value in enumerate(obj)]

    return read


def _read_array(cls: type[Any], obj: Any, path: str) -> Any:
    if isinstance(obj, cls):
        return obj
    try:
        if isinstance(obj, (list, array)):
            return cls(obj)
    except (TypeError, ValueError, OverflowError):
        pass
    raise _wrong(path, obj, f"a list of {_HOLDS[cls.code]}")


def _read_float(obj: Any, path: str) -> float:
    if obj is None:
        return math.nan
    if isinstance(obj, (int, float)) and not isinstance(obj, bool):
        try:
            return float(obj)
        except OverflowError:
            pass
    raise _wrong(path, obj, "a number or null")


def _read_int(obj: Any, path: str) -> int:
    if isinstance(obj, int) and not isinstance(obj, bool) and -(2**63) <= obj < 2**64:
        return obj
    raise _wrong(path, obj, "a whole number of at most 64 bits")


def _read_bool(obj: Any, path: str) -> bool:
    if isinstance(obj, bool):
        return obj
    raise _wrong(path, obj, "true or false")


def _read_str(obj: Any, path: str) -> str:
    if isinstance(obj, str):
        return obj
    raise _wrong(path, obj, "a text")


def _read_bytes(obj: Any, path: str) -> bytes:
    try:
        if isinstance(obj, bytes):
            return obj
        if isinstance(obj, str):
            return base64.b64decode(obj, validate=True)
        if isinstance(obj, (list, array)):
            return bytes(obj)
    except (binascii.Error, ValueError, TypeError):
        pass
    raise _wrong(path, obj, "base64 text or a list of whole numbers from 0 to 255")


_SCALARS: dict[Any, Reader] = {
    float: _read_float,
    int: _read_int,
    bool: _read_bool,
    str: _read_str,
    bytes: _read_bytes,
}


def _wrong(path: str, value: object, allowed: str) -> ProtocolError:
    return ProtocolError(f"{path} must be {allowed}, not {shown(value)}.")


def shown(value: object) -> str:
    """`value` as it may stand in a sentence: JSON where possible, at most 60 characters."""
    try:
        text = msgspec.json.encode(value, enc_hook=str).decode()
    except (OverflowError, UnicodeEncodeError, TypeError, ValueError, RecursionError):
        text = ascii(value)
    return text if len(text) <= 60 else f"{text[:59]}…"
