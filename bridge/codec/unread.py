"""Messages that are passed on unchanged: checked like any other, and decoded only for a client that wants another
form."""

from __future__ import annotations

import functools
import typing
from typing import Any

import msgspec

from bridge.codec.decoders import decoder_of
from bridge.codec.fields import HEADER, fields_of
from bridge.codec.headers import has_header, with_count
from bridge.codec.reader import WIDTHS, least_and_most
from bridge.codec.text import from_json
from bridge.msgs import Msg
from bridge.msgs.arrays import ARRAYS

__all__ = ["Unread", "unread"]

_ARRAYS = tuple(ARRAYS.values())
_HEADER_WITHIN = 1024
"""A count is looked for in so many bytes at the front, where headers stand."""


class Unread:
    """JSON text of a whole message of a known type, in ROS 1's names."""

    __slots__ = ("_type", "text")

    def __init__(self, text: bytes, type: type[Msg]) -> None:
        self.text = text
        self._type = type

    def read(self) -> Msg:
        """The message."""
        return from_json(self.text, self._type)


def unread(raw: msgspec.Raw, type: type[Msg]) -> Unread | None:
    """The text as it is, if it holds each field of `type`, each of its kind, and no other; None where it must be
    decoded.

    Headers without a count, as most programs write them, get one. Missing, ROS 2's and wrong fields are left to
    `from_json`, which fills in, translates and reports.
    """
    text = bytes(raw)
    counted = not has_header(type) or text.find(b'"seq"', 0, _HEADER_WITHIN) >= 0
    decoder = _decoder(type, counted)
    if decoder is None:
        return None
    try:
        decoder.decode(raw)
    except (msgspec.MsgspecError, OverflowError, UnicodeError, RecursionError):
        return None
    whole = text if counted else with_count(text, type)
    return None if whole is None else Unread(whole, type)


@functools.lru_cache(maxsize=1024)
def _decoder(type: type[Msg], counted: bool) -> msgspec.json.Decoder[Any] | None:
    """The checking decoder; None for a type that cannot be checked this way."""
    try:
        return decoder_of(_strict(type, counted))
    except (TypeError, ValueError):
        return None


@functools.lru_cache(maxsize=1024)
def _strict(type: type[Msg], counted: bool) -> Any:
    """A record with the fields of `type`, all of them required and no other allowed; headers have their count, or have
    none."""
    fields = [field for field in fields_of(type) if counted or type.MSGTYPE != HEADER or field.key != "seq"]
    return msgspec.defstruct(
        type.__name__,
        [(field.name, _needed(field.hint, counted)) for field in fields],
        rename={field.name: field.key for field in fields},
        forbid_unknown_fields=True,
        frozen=True,
        gc=False,
    )


def _needed(hint: Any, counted: bool) -> Any:
    """The JSON type that a field of this type requires."""
    if typing.get_origin(hint) is typing.Annotated:
        inner, *told = typing.get_args(hint)
        return typing.Annotated[(_needed(inner, counted), *told)]
    if hint is float:
        return float | None
    if typing.get_origin(hint) is list:
        return list[_needed(typing.get_args(hint)[0], counted)]  # type: ignore[misc]
    if isinstance(hint, type) and issubclass(hint, Msg):
        return _strict(hint, counted)
    if isinstance(hint, type) and issubclass(hint, _ARRAYS):
        return list[_number(hint.code)]  # type: ignore[misc]
    return hint


def _number(code: str) -> Any:
    if code not in WIDTHS:
        return float | None
    least, most = least_and_most(code)
    return typing.Annotated[int, msgspec.Meta(ge=least, le=min(most, 2**63 - 1))]
