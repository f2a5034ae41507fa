"""Operations to text and back, without I/O: what a frame holds, or one sentence that says what is wrong with it."""

from __future__ import annotations

import functools
import json
import re

import msgspec
from msgspec import Raw

from bridge.codec import from_builtins, from_cbor, from_json, shown
from bridge.errors import ProtocolError
from bridge.msgs import Msg
from bridge.protocol.ops import OPS, BinaryPublish, Op

__all__ = ["absolute", "arguments", "dump", "encode", "parse", "parse_binary"]

_NAMES = tuple(str(op.__struct_config__.tag) for op in OPS)


@functools.cache
def _decoder() -> msgspec.json.Decoder[Op]:
    union = functools.reduce(lambda left, right: left | right, OPS)  # type: ignore[arg-type,return-value]
    return msgspec.json.Decoder(union)


_ENCODER = msgspec.json.Encoder()
_BARE = re.compile(r"\b(NaN|Infinity)\b")


def parse(text: str | bytes) -> Op:
    """The operation in one frame of text; ProtocolError with the first 80 characters when it is none."""
    try:
        return _decode(text)
    except ProtocolError:
        repaired = _without_nan(text)
        if repaired is None:
            raise
    return _decode(repaired)


def parse_binary(raw: bytes) -> BinaryPublish:
    """The publish operation in one binary frame; ProtocolError when it is none."""
    obj = from_cbor(raw)
    if not isinstance(obj, dict) or obj.get("op") != "publish" or not isinstance(obj.get("topic"), str):
        raise ProtocolError(f"A binary frame must hold a publish operation, not {shown(obj)}.")
    return BinaryPublish(obj["topic"], obj.get("msg", {}))


def encode(op: Op) -> bytes:
    """`op` as JSON text in UTF-8."""
    return _ENCODER.encode(op)


def dump(op: Op) -> str:
    """`op` as JSON text."""
    return encode(op).decode()


def absolute(name: str) -> str:
    """A topic's or service's name with its leading slash, as ROS resolves a relative one."""
    return name if name.startswith("/") else f"/{name}"


def arguments(raw: Raw, type: type[Msg]) -> Msg:
    """A service's request in `CallService.args`: an object, a list of fields in their order, or null."""
    text = bytes(raw).lstrip()
    if text.startswith(b"{"):
        return from_json(raw, type)
    values = msgspec.json.decode(text)
    if values is None:
        return type()
    if not isinstance(values, list):
        raise ProtocolError(f"args must be an object or a list, not {shown(values)}.")
    return from_builtins(dict(zip(type.__struct_fields__, values, strict=False)), type)


def _decode(text: str | bytes) -> Op:
    try:
        return _decoder().decode(text)
    except (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError) as error:
        raise ProtocolError(_explain(error, text)) from error


def _without_nan(text: str | bytes) -> bytes | None:
    """The same JSON with `null` where Python's own encoder writes NaN or Infinity; None when neither is there."""
    try:
        decoded = text if isinstance(text, str) else text.decode()
        if not _BARE.search(decoded):
            return None
        repaired = msgspec.json.encode(json.loads(decoded))
    except (ValueError, RecursionError, OverflowError, TypeError):
        return None
    return repaired


_PLACE = re.compile(r"Expected `(?P<wanted>.+?)`, got `(?P<found>.+?)`(?: - at `\$\.?(?P<path>.*)`)?$")
_MISSING = re.compile(r"Object missing required field `(?P<field>.+?)`")


def _explain(error: Exception, text: str | bytes) -> str:
    start = text[:80] if isinstance(text, str) else text[:80].decode(errors="replace")
    try:
        obj = msgspec.json.decode(text)
    except (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError):
        return f"This is not JSON: {start!r}."
    if not isinstance(obj, dict):
        return f"An operation must be an object, not {start!r}."
    if obj.get("op") not in _NAMES:
        return f"op must be one of {', '.join(_NAMES)}, not {shown(obj.get('op'))}."
    if found := _PLACE.search(str(error)):
        allowed = found["wanted"].replace(" | ", " or ")
        return f"{obj['op']}: {found['path']} must be {allowed}, not {found['found']}: {start!r}."
    if found := _MISSING.search(str(error)):
        return f"{obj['op']} needs the field {found['field']}: {start!r}."
    return f"{obj['op']}: {error}: {start!r}."
