"""Operations to JSON text or CBOR and back, without I/O; a fault is one sentence."""

from __future__ import annotations

import functools
import json
import re

import msgspec
from msgspec import UNSET, Raw, UnsetType

from bridge.codec import check_cbor, from_cbor, from_json, shown
from bridge.codec.decoders import decoder_of
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.protocol.names import MAX_ID_LENGTH
from bridge.protocol.ops import LEVELS, OPS, ActionResult, BinaryPublish, Op, Status

__all__ = [
    "MAX_ARGUMENT_BYTES",
    "MAX_OPERATIONS",
    "arguments",
    "complaint",
    "dump",
    "encode",
    "goal_status",
    "parse",
    "parse_binary",
    "parse_each",
    "too_deep",
]

MAX_OPERATIONS = 1000
"""Most operations in one frame."""
MAX_SHARED_BYTES = 1_048_576
"""The largest frame that is searched for several operations [byte]."""
MAX_ARGUMENT_BYTES = 1_048_576
"""The longest text of a request or a goal that is read [byte]."""
_DEEPEST = 100
_MAX_GAPS = 100_000
"""Most places between the texts of a frame that are searched for bare NaNs."""
_MAX_SCALAR_LENGTH = 8 * MAX_ID_LENGTH
_MAX_REDUCTION_LENGTH = 65_536
_NAMES = tuple(str(op.__struct_config__.tag) for op in OPS)
_FAULTS = (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError, ValueError)
"""Errors that msgspec and json raise for texts that are no JSON, or no JSON of this shape."""


@functools.cache
def _decoder() -> msgspec.json.Decoder[Op]:
    union = functools.reduce(lambda left, right: left | right, OPS)  # type: ignore[arg-type,return-value]
    return decoder_of(union)


_ENCODER = msgspec.json.Encoder()
_NULLABLE = ("id", "msg", "args", "values", "fragment_size")
_FIELDS = msgspec.json.Decoder(
    msgspec.defstruct(
        "Fields",
        [
            (name, Raw | UnsetType, UNSET)
            for name in sorted({"op"} | {field for op in OPS for field in op.__struct_fields__})
        ],
    )
)
"""The fields that any operation has, undecoded; a frame may hold any number of others, which cost nothing this way."""
_SCANNER = json.JSONDecoder()
_STRING = rb'"[^"\\]*+(?:\\.[^"\\]*+)*+(?:"|\\?\Z)'
_GAP_WITH_NAN = re.compile(rb"((?:[^\"NI-]++|" + _STRING + rb')*+)([^"]*+)', re.DOTALL)
_SPACES = re.compile(r"[ \t\r\n]*+")


def parse(text: str | bytes) -> Op:
    """The operation in one text frame; ProtocolError with its first 80 characters when it is none.

    Bare NaN and Infinity, as Python writes them, count as null. Unknown fields are ignored, and so is null where it
    means nothing.
    """
    try:
        if isinstance(text, bytes) and not text.isascii():
            text.decode()  # the decoder does not look at the texts of a message, which may be passed on as it is
        return _decoder().decode(text)
    except UnicodeError as error:
        raise _explained(error, text, b"") from error
    except _FAULTS as error:
        fault = error
    raw = b""
    try:
        whole = text.encode() if isinstance(text, str) else text
        raw = _without_nan(whole)
        if raw is not whole:
            return _decoder().decode(raw)
    except _FAULTS as error:
        fault = error
    if isinstance(fault, msgspec.ValidationError):
        try:
            return _decoder().decode(_without_nulls(raw))
        except _FAULTS as error:
            fault = error
    raise _explained(fault, text, raw) from fault


def parse_each(text: str | bytes, alone: ProtocolError | None = None) -> list[Op | ProtocolError]:
    """The operations in one text frame, which may hold several in a row; a faulty one as its error.

    Text behind something that is no JSON cannot be separated from it and is one error with it. `alone` is the error
    of `parse` for the whole frame, where that was tried before.
    """
    if alone is None:
        try:
            return [parse(text)]
        except ProtocolError as error:
            alone = error
    pieces = _pieces(text) if len(text) <= MAX_SHARED_BYTES else []
    if len(pieces) < 2:
        return [alone]
    found: list[Op | ProtocolError] = []
    for piece in pieces[:MAX_OPERATIONS]:
        try:
            found.append(parse(piece))
        except ProtocolError as error:
            found.append(error)
    if len(pieces) > MAX_OPERATIONS:
        found.append(ProtocolError(f"A frame may hold at most {MAX_OPERATIONS} operations."))
    return found


def parse_binary(raw: bytes, most_values: int | None = None) -> BinaryPublish:
    """The publish operation in one frame of CBOR; ProtocolError when it is none.

    Also when it holds over `most_values` values, a number array counted as one, or tags other than those of arrays.
    """
    if most_values is not None:
        check_cbor(raw, most_values)
    obj = from_cbor(raw)
    if not isinstance(obj, dict) or obj.get("op") != "publish" or not isinstance(obj.get("topic"), str):
        try:
            found = shown(obj)
        except RecursionError:
            found = "something nested too deeply"
        raise ProtocolError(f"A binary frame must hold a publish operation, not {found}.")
    return BinaryPublish(obj["topic"], obj.get("msg", {}))


def encode(op: Op) -> bytes:
    """`op` as JSON text in UTF-8; ProtocolError for values that JSON cannot represent."""
    try:
        return _ENCODER.encode(op)
    except (UnicodeEncodeError, OverflowError, TypeError, ValueError) as error:
        name = str(op.__struct_config__.tag)
        raise ProtocolError(f"{name} cannot be sent: {error}.", op=name) from error


def dump(op: Op) -> str:
    """`op` as JSON text; ProtocolError for values that JSON cannot represent."""
    return encode(op).decode()


def complaint(error: ProtocolError, level: str = "error") -> Status:
    """The remark to a client about `error`: its sentence with the operation's name and id, as far as they are known."""
    if level not in LEVELS:
        raise ProtocolError(f"level must be one of {', '.join(LEVELS)}, not {shown(level)}.")
    about = "" if error.op is None else error.op if error.id is None else f"{error.op} {shown(error.id)}"
    sentence = f"{about}: {error}" if about else str(error)
    return (
        Status(id=error.id, level=level, msg=sentence)
        if error.id is not None
        else Status(level=level, msg=sentence)
    )


def arguments(raw: Raw, type: type[Msg]) -> Msg:
    """A request or a goal in `args`: an object, a list of the fields in their order, or null.

    ProtocolError when it is none of them, or over `MAX_ARGUMENT_BYTES`.
    """
    text = bytes(raw).lstrip()
    if len(text) > MAX_ARGUMENT_BYTES:
        raise ProtocolError(
            f"args of {type.MSGTYPE} may have at most {MAX_ARGUMENT_BYTES} bytes, not {len(text)}."
        )
    if text.startswith(b"{"):
        return from_json(raw, type)
    try:
        if text.startswith(b"["):
            listed = msgspec.structs.astuple(msgspec.json.decode(text, type=_listed(type)))
            named = zip(type.__struct_encode_fields__, listed, strict=True)
            return from_json(_ENCODER.encode({name: each for name, each in named if each is not UNSET}), type)
        values = msgspec.json.decode(text)
    except _FAULTS as error:
        raise ProtocolError(f"args of {type.MSGTYPE} cannot be read: {error}.") from error
    if values is None:
        return type()
    raise ProtocolError(f"args must be an object or a list, not {shown(values)}.")


@functools.lru_cache(maxsize=1024)
def _listed(type: type[Msg]) -> type[msgspec.Struct]:
    """The fields of `type` in their order, undecoded; a list may be longer."""
    fields = [(f"f{place}", Raw | UnsetType, UNSET) for place in range(len(type.__struct_fields__))]
    return msgspec.defstruct("Listed", fields, array_like=True)


def goal_status(op: ActionResult) -> int:
    """The status of a result, as in action_msgs/GoalStatus; some servers send it among the values. 0 when unknown."""
    status: object = op.status
    if not status:
        try:
            status = _scalar(_FIELDS.decode(op.values).status)  # type: ignore[attr-defined]
        except _FAULTS:
            return 0
    if isinstance(status, bool) or not isinstance(status, (int, float)) or not 0 <= status <= 6:
        return 0
    return int(status)


def too_deep(text: bytes, limit: int = _DEEPEST) -> bool:
    """Whether lists and objects of a JSON text are nested more than `limit` deep.

    For texts that are passed on undecoded: many a client's parser gives up where ours does not.
    """
    if text.count(b"[") + text.count(b"{") <= limit:
        return False
    return _flat(limit).fullmatch(text) is None


@functools.cache
def _flat(limit: int) -> re.Pattern[bytes]:
    """A pattern that matches texts nested at most `limit` deep; a loop over the brackets in Python takes ten times as
    long."""
    other = rb'[^"\[\]{}]*+'
    inner = other + rb"(?:" + _STRING + other + rb")*+"
    for _ in range(limit):
        inner = other + rb"(?:(?:" + _STRING + rb"|[\[{]" + inner + rb"(?:[\]}]|\Z))" + other + rb")*+"
    return re.compile(inner, re.DOTALL)


def _without_nan(raw: bytes) -> bytes:
    """The same JSON with `null` where Python's encoder writes NaN or Infinity; ValueError where that is too much work."""
    if b"NaN" not in raw and b"Infinity" not in raw:
        return raw
    gaps = 0

    def nulled(found: re.Match[bytes]) -> bytes:
        nonlocal gaps
        gaps += 1
        if gaps > _MAX_GAPS:
            raise ValueError("there are too many texts among bare NaNs")
        gap = found[2]
        for word in (b"-NaN", b"NaN", b"-Infinity", b"Infinity"):
            gap = gap.replace(word, b"null")
        return found[1] + gap

    return _GAP_WITH_NAN.sub(nulled, raw)


def _without_nulls(raw: bytes) -> bytes:
    """The same operation without null where it means nothing, and with floats for whole numbers made whole."""
    kept: dict[str, object] = {}
    for name, value in msgspec.structs.asdict(_FIELDS.decode(raw)).items():
        if value is UNSET or (bytes(value) == b"null" and name not in _NULLABLE):
            continue
        whole = name in ("status", "reduce") and len(value) <= _MAX_REDUCTION_LENGTH
        kept[name] = _whole_numbers(msgspec.json.decode(value)) if whole else value
    return _ENCODER.encode(kept)


def _whole_numbers(obj: object) -> object:
    if isinstance(obj, dict):
        return {name: _whole_numbers(value) for name, value in obj.items()}
    return int(obj) if isinstance(obj, float) and obj.is_integer() else obj


def _pieces(text: str | bytes) -> list[str]:
    """The JSON objects of a text that holds nothing else, except for a faulty last piece; at most one too many."""
    pieces: list[str] = []
    try:
        whole = text if isinstance(text, str) else text.decode()
    except UnicodeDecodeError:
        return pieces
    place = _after_space(whole, 0)
    while place < len(whole) and len(pieces) <= MAX_OPERATIONS:
        try:
            _, end = _SCANNER.raw_decode(whole, place)
        except (ValueError, RecursionError):
            end = len(whole)
        pieces.append(whole[place:end])
        place = _after_space(whole, end)
    return pieces


def _after_space(text: str, place: int) -> int:
    found = _SPACES.match(text, place)
    return found.end() if found else place


_PLACE = re.compile(r"Expected `(?P<wanted>.+?)`, got `(?P<found>.+?)`(?: - at `\$\.?(?P<path>.*)`)?$")
_MISSING = re.compile(r"Object missing required field `(?P<field>.+?)`")


def _explained(error: Exception, text: str | bytes, raw: bytes) -> ProtocolError:
    start = text[:80] if isinstance(text, str) else text[:80].decode(errors="replace")
    if isinstance(error, RecursionError):
        return ProtocolError(f"This is nested too deeply: {start!r}.")
    if isinstance(error, UnicodeError):
        return ProtocolError(f"This is not UTF-8: {start!r}.")
    try:
        msgspec.json.decode(raw, type=Raw)
    except _FAULTS:
        return ProtocolError(f"This is not JSON: {start!r}.")
    if not raw.lstrip().startswith(b"{"):
        return ProtocolError(f"An operation must be an object, not {start!r}.")
    fields = _FIELDS.decode(raw)
    op, id = _scalar(fields.op), _scalar(fields.id)  # type: ignore[attr-defined]
    if op not in _NAMES:
        return ProtocolError(f"op must be one of {', '.join(_NAMES)}, not {shown(op)}.", id=id)
    return ProtocolError(f"{_sentence(str(op), str(error))}: {start!r}.", op=str(op), id=id)


def _sentence(op: str, fault: str) -> str:
    if found := _PLACE.search(fault):
        allowed = found["wanted"].replace(" | ", " or ")
        return f"{op}: {found['path']} must be {allowed}, not {found['found']}"
    if found := _MISSING.search(fault):
        return f"{op} needs the field {found['field']}"
    return f"{op}: {fault}"


def _scalar(raw: Raw | UnsetType) -> str | float | None:
    """A short text or a number; None for anything else."""
    if raw is UNSET or len(raw) > _MAX_SCALAR_LENGTH:
        return None
    try:
        value = msgspec.json.decode(raw)
    except _FAULTS:
        return None
    usable = isinstance(value, (str, int, float)) and not isinstance(value, bool)
    return value if usable and len(str(value)) <= MAX_ID_LENGTH else None
