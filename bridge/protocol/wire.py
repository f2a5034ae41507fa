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
from bridge.protocol.names import LONGEST_ID
from bridge.protocol.ops import LEVELS, OPS, ActionResult, BinaryPublish, Op, Status

__all__ = [
    "MOST_OPERATIONS",
    "arguments",
    "complaint",
    "dump",
    "encode",
    "goal_status",
    "parse",
    "parse_binary",
    "parse_each",
    "parse_many",
    "too_deep",
]

MOST_OPERATIONS = 1000
"""So many operations may stand in one frame."""
_NAMES = tuple(str(op.__struct_config__.tag) for op in OPS)
_FAULTS = (msgspec.MsgspecError, UnicodeError, RecursionError, OverflowError, ValueError)
"""What msgspec and json raise for texts that are no JSON, or no JSON of this shape."""


@functools.cache
def _decoder() -> msgspec.json.Decoder[Op]:
    union = functools.reduce(lambda left, right: left | right, OPS)  # type: ignore[arg-type,return-value]
    return msgspec.json.Decoder(union)


_ENCODER = msgspec.json.Encoder()
_FIELDS = msgspec.json.Decoder(dict[str, Raw])
_SCANNER = json.JSONDecoder()
_STRING_OR_NAN = re.compile(rb'"[^"\\]*+(?:\\.[^"\\]*+)*+(?:"|\\?\Z)|-?\b(?:NaN|Infinity)\b', re.DOTALL)
_STRING_OR_BRACKET = re.compile(rb'"[^"\\]*+(?:\\.[^"\\]*+)*+(?:"|\\?\Z)|[\[{]|[\]}]', re.DOTALL)
_SPACES = re.compile(r"[ \t\r\n]*+")
_NULLABLE = ("id", "msg", "args", "values", "fragment_size")


def parse(text: str | bytes) -> Op:
    """The operation in one frame of text; ProtocolError with the first 80 characters when it is none.

    Bare NaN and Infinity, as Python writes them, count as null. Fields that nobody knows are passed over, and so is null
    where it means nothing.
    """
    try:
        if isinstance(text, bytes) and not text.isascii():
            text.decode()  # the decoder does not look at the texts of a message, which may be passed on as it is
        return _decoder().decode(text)
    except UnicodeError as error:
        raise _explained(error, text) from error
    except _FAULTS as error:
        fault = error
    try:
        raw = _without_nan(text.encode() if isinstance(text, str) else text)
        return _decoder().decode(raw)
    except _FAULTS as error:
        fault = error
    if isinstance(fault, msgspec.ValidationError):
        try:
            return _decoder().decode(_without_nulls(raw))
        except _FAULTS as error:
            fault = error
    raise _explained(fault, text) from fault


def parse_each(text: str | bytes) -> list[Op | ProtocolError]:
    """The operations in one frame of text, which may hold several one after the other; what is none as its error.

    What follows something that is no JSON cannot be told apart and is one error with it.
    """
    try:
        return [parse(text)]
    except ProtocolError as error:
        alone = error
    pieces = _pieces(text)
    if len(pieces) < 2:
        return [alone]
    found: list[Op | ProtocolError] = []
    for piece in pieces[:MOST_OPERATIONS]:
        try:
            found.append(parse(piece))
        except ProtocolError as error:
            found.append(error)
    if len(pieces) > MOST_OPERATIONS:
        found.append(ProtocolError(f"A frame may hold at most {MOST_OPERATIONS} operations."))
    return found


def parse_many(text: str | bytes) -> list[Op]:
    """The operations in one frame of text, one or several; the first ProtocolError when any of them is none."""
    found = []
    for each in parse_each(text):
        if isinstance(each, ProtocolError):
            raise each
        found.append(each)
    return found


def parse_binary(raw: bytes) -> BinaryPublish:
    """The publish operation in one frame of CBOR; ProtocolError when it is none."""
    obj = from_cbor(raw)
    if not isinstance(obj, dict) or obj.get("op") != "publish" or not isinstance(obj.get("topic"), str):
        try:
            found = shown(obj)
        except RecursionError:
            found = "something nested too deeply"
        raise ProtocolError(f"A binary frame must hold a publish operation, not {found}.")
    return BinaryPublish(obj["topic"], obj.get("msg", {}))


def encode(op: Op) -> bytes:
    """`op` as JSON text in UTF-8; ProtocolError when it holds what JSON cannot say."""
    try:
        return _ENCODER.encode(op)
    except (UnicodeEncodeError, OverflowError, TypeError, ValueError) as error:
        name = str(op.__struct_config__.tag)
        raise ProtocolError(f"{name} cannot be sent: {error}.", op=name) from error


def dump(op: Op) -> str:
    """`op` as JSON text; ProtocolError when it holds what JSON cannot say."""
    return encode(op).decode()


def complaint(error: ProtocolError, level: str = "error") -> Status:
    """What to tell a client about `error`: its sentence with the operation's name and id, as far as they are known."""
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
    """A request or a goal in `args`: an object, a list of the fields in their order, or null."""
    text = bytes(raw).lstrip()
    if text.startswith(b"{"):
        return from_json(raw, type)
    try:
        values = msgspec.json.decode(text)
    except _FAULTS as error:
        raise ProtocolError(f"args of {type.MSGTYPE} cannot be read: {error}.") from error
    if values is None:
        return type()
    if not isinstance(values, list):
        raise ProtocolError(f"args must be an object or a list, not {shown(values)}.")
    return from_builtins(dict(zip(type.__struct_fields__, values, strict=False)), type)


def goal_status(op: ActionResult) -> int:
    """What became of a goal, as in action_msgs/GoalStatus; some servers say it among the values. 0 when unknown."""
    status: object = op.status
    if not status:
        try:
            values = _FIELDS.decode(op.values)
            status = msgspec.json.decode(values.get("status", b"0"))
        except _FAULTS:
            return 0
    if isinstance(status, bool) or not isinstance(status, (int, float)) or not 0 <= status <= 6:
        return 0
    return int(status)


def too_deep(text: bytes, limit: int = 100) -> bool:
    """Whether lists and objects of a JSON text stand in one another more than `limit` deep.

    For what is passed on unread: many a client's parser gives up where ours does not.
    """
    if text.count(b"[") + text.count(b"{") <= limit:
        return False
    depth = 0
    for token in _STRING_OR_BRACKET.finditer(text):
        first = text[token.start()]
        if first in b"[{":
            depth += 1
            if depth > limit:
                return True
        elif first in b"]}":
            depth -= 1
    return False


def _without_nan(raw: bytes) -> bytes:
    """The same JSON with `null` where Python's own encoder writes NaN or Infinity."""
    if b"NaN" not in raw and b"Infinity" not in raw:
        return raw
    return _STRING_OR_NAN.sub(lambda found: found[0] if found[0][:1] == b'"' else b"null", raw)


def _without_nulls(raw: bytes) -> bytes:
    """The same operation without null where a null means nothing, and with whole numbers that came as floats whole."""
    fields = _FIELDS.decode(raw)
    kept: dict[str, object] = {}
    for name, value in fields.items():
        if bytes(value) == b"null" and name not in _NULLABLE:
            continue
        whole = name in ("status", "reduce")
        kept[name] = _whole_numbers(msgspec.json.decode(value)) if whole else value
    return _ENCODER.encode(kept)


def _whole_numbers(obj: object) -> object:
    if isinstance(obj, dict):
        return {name: _whole_numbers(value) for name, value in obj.items()}
    return int(obj) if isinstance(obj, float) and obj.is_integer() else obj


def _pieces(text: str | bytes) -> list[str]:
    """The JSON objects of a text that holds nothing else, but for a last piece that is none; at most one too many."""
    pieces: list[str] = []
    try:
        whole = text if isinstance(text, str) else text.decode()
    except UnicodeDecodeError:
        return pieces
    place = _after_space(whole, 0)
    while place < len(whole) and len(pieces) <= MOST_OPERATIONS:
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


def _explained(error: Exception, text: str | bytes) -> ProtocolError:
    start = text[:80] if isinstance(text, str) else text[:80].decode(errors="replace")
    if isinstance(error, RecursionError):
        return ProtocolError(f"This is nested too deeply: {start!r}.")
    if isinstance(error, UnicodeError):
        return ProtocolError(f"This is not UTF-8: {start!r}.")
    try:
        raw = _without_nan(text.encode() if isinstance(text, str) else text)
        msgspec.json.decode(raw, type=Raw)
    except _FAULTS:
        return ProtocolError(f"This is not JSON: {start!r}.")
    if not raw.lstrip().startswith(b"{"):
        return ProtocolError(f"An operation must be an object, not {start!r}.")
    fields = _FIELDS.decode(raw)
    op, id = _scalar(fields.get("op")), _scalar(fields.get("id"))
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


def _scalar(raw: Raw | None) -> str | float | None:
    """A short text or a number; None for anything else."""
    try:
        value = None if raw is None else msgspec.json.decode(raw)
    except _FAULTS:
        return None
    usable = isinstance(value, (str, int, float)) and not isinstance(value, bool)
    return value if usable and len(str(value)) <= LONGEST_ID else None
