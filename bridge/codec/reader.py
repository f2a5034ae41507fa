"""Messages from decoded JSON or CBOR, each field checked; an error names the field, its value and what is allowed."""

from __future__ import annotations

import base64
import binascii
import functools
import math
import types
import typing
from array import array
from collections.abc import Callable
from typing import Any, TypeVar

import msgspec

from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.arrays import ARRAYS

__all__ = ["WIDTHS", "from_builtins", "least_and_most", "shown", "to_builtins"]

M = TypeVar("M", bound=Msg)
Reader = Callable[[Any, str], Any]
"""Makes a field's value of the decoded one; the text is the field's path, for the error."""

_TYPED = tuple(ARRAYS.values())
WIDTHS = {"b": 8, "B": 8, "h": 16, "H": 16, "i": 32, "I": 32, "q": 64, "Q": 64}
"""Bits of each whole number, by its code in `array.array`."""


def to_builtins(msg: Msg) -> dict[str, Any]:
    """`msg` as dicts, lists and numbers; bytes and typed arrays are left as they are."""
    return typing.cast("dict[str, Any]", msgspec.to_builtins(msg, builtin_types=(bytes, *_TYPED)))


def from_builtins(obj: object, type: type[M]) -> M:
    """The message in decoded JSON or CBOR; same rules as `from_json`."""
    try:
        return typing.cast(M, _reader(type)(obj, ""))
    except RecursionError as error:
        raise ProtocolError(f"{type.MSGTYPE} is nested too deeply.") from error


@functools.lru_cache(maxsize=4096)
def _reader(hint: Any) -> Reader:
    if typing.get_origin(hint) is typing.Annotated:
        hint, *told = typing.get_args(hint)
        return _within(_reader(hint), [each for each in told if isinstance(each, msgspec.Meta)])
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
    fields = [(field.name, field.encode_name, _reader(field.type)) for field in msgspec.structs.fields(type)]

    def read(obj: Any, path: str) -> Msg:
        if isinstance(obj, type):
            return obj
        if not isinstance(obj, dict):
            raise _wrong(path or type.MSGTYPE, obj, "an object")
        prefix = f"{path}." if path else ""
        return type(
            **{name: reader(obj[key], f"{prefix}{key}") for name, key, reader in fields if key in obj}
        )

    return read


def _list_reader(item: Reader) -> Reader:
    def read(obj: Any, path: str) -> list[Any]:
        if not isinstance(obj, (list, array)):
            raise _wrong(path, obj, "a list")
        if (
            isinstance(obj, array) and obj
        ):  # all of a kind: what holds for the first, least and most holds for all
            if item is _read_float and obj.typecode in "fd":
                return obj.tolist()
            kinds = {
                type(item(value, f"{path}[{obj.index(value)}]")) for value in (obj[0], min(obj), max(obj))
            }
            return list(map(float, obj)) if kinds == {float} else obj.tolist()
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
    raise _wrong(path, obj, f"a list of {_held(cls.code)}")


def _held(code: str) -> str:
    if code in "fd":
        return "numbers"
    least, most = least_and_most(code)
    return f"whole numbers from {least} to {most}"


def least_and_most(code: str) -> tuple[int, int]:
    """The range of a whole number with this code of `array.array`, one of `WIDTHS`."""
    bits = WIDTHS[code]
    return (0, 2**bits - 1) if code.isupper() else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


def _within(read: Reader, told: list[msgspec.Meta]) -> Reader:
    """A reader that also checks the annotations of a type: range of a number, length of a text or array."""

    def checked(obj: Any, path: str) -> Any:
        value = read(obj, path)
        for meta in told:
            _check_range(meta, value, path)
            _check_length(meta, value, path)
        return value

    return checked


def _check_range(meta: msgspec.Meta, value: Any, path: str) -> None:
    least, most = meta.ge, meta.le
    if least is None or most is None:
        return
    if (least, most) == (0, 2**63 - 1):  # msgspec cannot say what a uint64 holds
        most = 2**64 - 1
    if not least <= value <= most:
        raise _wrong(path, value, f"a whole number from {least} to {most}")


def _check_length(meta: msgspec.Meta, value: Any, path: str) -> None:
    least, most = meta.min_length, meta.max_length
    if least is None and most is None:
        return
    if least is not None and least == most and len(value) != most:
        raise ProtocolError(f"{path} must hold {most}, not {len(value)}.")
    if len(value) < (least or 0) or (most is not None and len(value) > most):
        raise ProtocolError(f"{path} must hold {least or 0} to {most or 'any number'}, not {len(value)}.")


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
    """`value` for a sentence: JSON where possible, at most 60 characters."""
    try:
        text = msgspec.json.encode(value, enc_hook=str).decode()
    except (OverflowError, UnicodeEncodeError, TypeError, ValueError, RecursionError):
        try:
            text = ascii(value)
        except ValueError:
            text = "a number with too many digits"
    return text if len(text) <= 60 else f"{text[:59]}…"
