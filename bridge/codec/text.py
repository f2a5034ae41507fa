"""Messages to JSON text and back."""

from __future__ import annotations

import functools
import typing
from array import array
from typing import Any, TypeVar

import msgspec

from bridge.codec.decoders import decoder_of
from bridge.codec.headers import without_count
from bridge.codec.reader import from_builtins
from bridge.codec.stamps import named_for_ros2
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg

__all__ = ["from_json", "to_json", "to_server_json"]

M = TypeVar("M", bound=Msg)


def to_json(msg: Msg, ros2: bool = False) -> bytes:
    """`msg` as JSON text in UTF-8; NaN and infinities become `null`. ProtocolError for values that JSON cannot
    represent.

    With `ros2` times and headers are those of ROS 2.
    """
    try:
        text = _ENCODER.encode(msg)
    except (UnicodeEncodeError, TypeError) as error:
        raise ProtocolError(f"{msg.MSGTYPE} cannot be sent: {error}.") from error
    return named_for_ros2(text, type(msg)) if ros2 else text


def to_server_json(msg: Msg, ros2: bool = False) -> bytes:
    """As `to_json`, for a server of another maker: without the count of headers.

    A server of ROS 1 counts itself, and one of ROS 2 drops a message with a field that it does not know.
    """
    text = to_json(msg, ros2)
    return text if ros2 else without_count(text, type(msg))


def from_json(raw: bytes | str | msgspec.Raw, type: type[M]) -> M:
    """The message in JSON text; missing fields take their defaults, `null` numbers become NaN.

    ProtocolError names the field, its value and what is allowed.
    """
    try:
        return typing.cast(M, _decoder(type).decode(raw))
    except (msgspec.MsgspecError, OverflowError, UnicodeError, RecursionError):
        return from_builtins(_loads(raw, type), type)


def _enc_hook(obj: object) -> object:
    if isinstance(obj, array):
        return obj.tolist()
    if isinstance(obj, str):  # a text that carries more is its text to others
        return str(obj)
    raise TypeError(f"{obj!r} has no JSON form")


def _dec_hook(type: type[Any], obj: object) -> object:
    if not isinstance(obj, list):
        raise TypeError("not a list")
    return type(obj)


_ENCODER = msgspec.json.Encoder(enc_hook=_enc_hook)


@functools.lru_cache(maxsize=1024)
def _decoder(type: type[Msg]) -> msgspec.json.Decoder[Any]:
    return decoder_of(type, _dec_hook)


def _loads(raw: bytes | str | msgspec.Raw, type: type[Msg]) -> Any:
    try:
        return msgspec.json.decode(raw)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise ProtocolError(f"{type.MSGTYPE} is not JSON: {error}.") from error
