"""The time of now in messages of clients: where they leave a header's stamp to the server, and where they write `now`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeVar

import msgspec
from msgspec import UNSET, Raw, UnsetType

from bridge.codec.fields import fields_of, is_time
from bridge.codec.reader import from_builtins
from bridge.codec.text import from_json
from bridge.msgs import Msg
from bridge.msgs.std_msgs import Header, Time

__all__ = ["from_json_now", "stamp_of"]

M = TypeVar("M", bound=Msg)
_NOW = "now"


class _Header(msgspec.Struct):
    stamp: Raw | UnsetType = UNSET


class _Headed(msgspec.Struct):
    header: _Header = msgspec.field(default_factory=_Header)


def stamp_of(seconds: float) -> Time:
    """The instant `seconds` [s] after the epoch; zero, ROS's word for no time, of NaN, where a robot has no clock."""
    return Time.at(seconds) if math.isfinite(seconds) else Time()


def from_json_now(raw: bytes | Raw, type: type[M], now: Callable[[], float]) -> M:
    """As `from_json`, with the time `now()` [s] for each time that is the text `now`, and for the stamp of the message's
    own header where that is missing."""
    text, stamp = bytes(raw), stamp_of(now())
    if b'"now"' in text and isinstance(obj := _loads(text), dict):
        msg = from_builtins(_timed(obj, type, stamp), type)
    else:
        msg = from_json(raw, type)
    header = getattr(msg, "header", None)
    if isinstance(header, Header) and header.stamp == Time() and not _is_stamped(text):
        return msgspec.structs.replace(msg, header=msgspec.structs.replace(header, stamp=stamp))
    return msg


def _loads(text: bytes) -> Any:
    try:
        return msgspec.json.decode(text)
    except (msgspec.MsgspecError, UnicodeError, RecursionError):
        return None  # `from_json` says what is wrong


def _is_stamped(text: bytes) -> bool:
    """Whether the message has a stamp in its header, even if that is zero."""
    return msgspec.json.decode(text, type=_Headed).header.stamp is not UNSET


def _timed(obj: Any, cls: type[Msg], stamp: Time) -> Any:
    """A decoded `cls` with `stamp` for each time that is `now`."""
    if not isinstance(obj, dict):
        return obj
    return obj | {
        field.key: _field(obj[field.key], field.type, stamp)
        for field in fields_of(cls)
        if field.type is not None and field.key in obj
    }


def _field(value: Any, cls: type[Msg], stamp: Time) -> Any:
    if isinstance(value, list):
        return [_field(each, cls, stamp) for each in value]
    if is_time(cls):
        return cls(stamp.secs, stamp.nsecs) if value == _NOW else value
    return _timed(value, cls, stamp)
