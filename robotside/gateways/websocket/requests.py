"""What a client of the plain WebSocket asks for: one JSON object with one verb, or one bare word."""

from __future__ import annotations

import math
import re

import msgspec
from msgspec import Raw

from bridge.core.errors import ProtocolError
from robotside.gateways.plain.strict_json import decode

__all__ = [
    "Call",
    "Cancel",
    "Id",
    "Publish",
    "Request",
    "Run",
    "Subscribe",
    "Token",
    "Unsubscribe",
    "any_id",
    "bare_word",
    "read_request",
    "says_stop",
]

Id = int | str | None
"""A client's own name for what it asked, repeated in the answer; None for none."""

MAX_ID = 64
"""Characters of an id."""
_EMPTY = Raw(b"{}")
_STOP = re.compile(rb'"(?:call|publish|run)"\s*:\s*"/?stop"', re.IGNORECASE)
_WORD = re.compile(rb"\s*([A-Za-z][\w -]{0,39}?)\s*", re.ASCII)


class Call(msgspec.Struct, forbid_unknown_fields=True):
    """Call a service."""

    call: str
    request: Raw = _EMPTY
    stamp: float = math.nan
    id: Id = None


class Publish(msgspec.Struct, forbid_unknown_fields=True):
    """Publish a message on a topic of the robot."""

    publish: str
    message: Raw = _EMPTY
    stamp: float = math.nan
    id: Id = None


class Subscribe(msgspec.Struct, forbid_unknown_fields=True):
    """Be sent a topic."""

    subscribe: str
    rate: float | None = None
    """Most messages a second [Hz]; None for the gateway's."""
    id: Id = None


class Unsubscribe(msgspec.Struct, forbid_unknown_fields=True):
    """Be sent a topic no longer."""

    unsubscribe: str
    id: Id = None


class Run(msgspec.Struct, forbid_unknown_fields=True):
    """Run an action."""

    run: str
    id: int | str
    """By which it can be cancelled."""
    goal: Raw = _EMPTY
    stamp: float = math.nan


class Cancel(msgspec.Struct, forbid_unknown_fields=True):
    """Cancel an action."""

    cancel: int | str
    """The id that it was run with."""
    id: Id = None


class Token(msgspec.Struct, forbid_unknown_fields=True):
    """Show a token."""

    token: str
    id: Id = None


Request = Call | Publish | Subscribe | Unsubscribe | Run | Cancel | Token

_DECODERS: dict[str, msgspec.json.Decoder[Request]] = {
    kind.__struct_fields__[0]: msgspec.json.Decoder(kind)
    for kind in (Call, Publish, Subscribe, Unsubscribe, Run, Cancel, Token)
}
"""By verb."""


def read_request(raw: bytes) -> Request:
    """What a message asks for; ProtocolError says what is wrong with it and what is allowed."""
    found = decode(raw)
    verbs = [verb for verb in _DECODERS if verb in found]
    if len(verbs) != 1:
        said = f"not {' and '.join(verbs)} at once" if verbs else "and this has none of them"
        raise ProtocolError(f"A message has one of {', '.join(_DECODERS)}, {said}.")
    decoder = _DECODERS[verbs[0]]
    try:
        request = decoder.decode(raw)
    except msgspec.ValidationError as error:
        fields = ", ".join(decoder.type.__struct_fields__)
        raise ProtocolError(f"{verbs[0]} is not understood: {error}. It takes {fields}.") from error
    if isinstance(request.id, str) and len(request.id) > MAX_ID:
        raise ProtocolError(f"An id has at most {MAX_ID} characters, not {len(request.id)}.")
    return request


def bare_word(raw: bytes) -> str:
    """The word of a message that is no JSON object, as in `home`; empty when it is none."""
    found = _WORD.fullmatch(raw)
    return found[1].decode() if found else ""


def says_stop(raw: bytes) -> bool:
    """Whether a message asks for STOP, whatever else it says or fails to say."""
    return bare_word(raw).lower() == "stop" or _STOP.search(raw) is not None


def any_id(raw: bytes) -> Id:
    """The id in a message that may be wrong otherwise; None when it cannot be read."""
    try:
        id = decode(raw).get("id")
    except ProtocolError:
        return None
    return id if isinstance(id, str | int) and len(str(id)) <= MAX_ID else None
