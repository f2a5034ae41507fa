"""What a CoAP request asks for, and why one is not done."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Hashable
from typing import Any, NamedTuple

import msgspec
from aiocoap.message import Message
from aiocoap.numbers.codes import Code as CoapCode
from aiocoap.numbers.optionnumbers import OptionNumber

from bridge.codec import to_json
from bridge.core.address import at_port
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, Refused
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.core.notice import Notice

__all__ = [
    "IMAGE",
    "JSON",
    "LINKS",
    "MAX_BLOCK",
    "TEXT",
    "Asked",
    "Body",
    "Failure",
    "address_of",
    "body_of",
    "code_of",
    "failure",
    "failure_of",
    "key_of_request",
    "read_asked",
]

TEXT, LINKS, JSON, IMAGE = 0, 40, 50, 22
"""Content formats: plain text, links, JSON, JPEG."""
MAX_BLOCK = 1024
"""Content of one message [byte]; more comes in blocks."""
MAX_NAME = 64
"""Characters of a client's name."""
_QUERY = ("token", "client", "stamp", "rate")
_KNOWN = frozenset(
    {
        OptionNumber.URI_HOST,
        OptionNumber.URI_PORT,
        OptionNumber.URI_PATH,
        OptionNumber.URI_QUERY,
        OptionNumber.ACCEPT,
        OptionNumber.BLOCK1,
        OptionNumber.BLOCK2,
    }
)
"""Of the options that must be understood, those that are."""
_CODES = {
    Code.TRUST_KEY: CoapCode.UNAUTHORIZED,
    Code.TRUST_UNKNOWN: CoapCode.UNAUTHORIZED,
    Code.TRUST_ATTEMPTS: CoapCode.UNAUTHORIZED,
    Code.TRUST_ROLE: CoapCode.FORBIDDEN,
    Code.GATEWAY_UNDATED: CoapCode.BAD_REQUEST,
    Code.GATEWAY_LEFT_OUT: CoapCode.NOT_FOUND,
    Code.GATEWAY_FULL: CoapCode.SERVICE_UNAVAILABLE,
    Code.GATEWAY_BUSY: CoapCode.SERVICE_UNAVAILABLE,
}


class Body(NamedTuple):
    """A content."""

    payload: bytes
    format: int
    """Content format."""

    @property
    def tag(self) -> bytes:
        """The same for the same content, and for no other."""
        return hashlib.sha256(self.payload).digest()[:8]


class Asked(NamedTuple):
    """A request."""

    path: str
    """As a name of ROS."""
    query: tuple[str, ...]
    token: str
    client: str
    """How the client calls itself."""
    stamp: float
    """When it was meant [s, operators' clock]; NaN when it does not say so."""
    rate: float
    """Notifications a second [Hz]; NaN when it does not say so."""
    accept: int | None
    """Content format of the answer."""


class Failure(Exception):
    """A request that is not done."""

    def __init__(self, code: CoapCode, said: str, word: str = "", **options: Any) -> None:
        """`code` is CoAP's, `word` that of the robot; `options` are those of the answer."""
        super().__init__(said)
        self.code, self.word, self._options = code, word, options

    def message(self, accept: int | None) -> Any:
        """The answer: the sentence as CoAP's diagnostic payload, or JSON for who accepts that."""
        said = str(self)[: MAX_BLOCK // 2]
        if accept == JSON:
            payload = msgspec.json.encode({"success": False, "message": said, "code": self.word})
            return Message(code=self.code, payload=payload, content_format=JSON, **self._options)
        return Message(code=self.code, payload=said.encode(), **self._options)


def failure(said: str, code: CoapCode = CoapCode.BAD_REQUEST, word: str = "") -> Failure:
    """The failure for a sentence."""
    return Failure(code, said, word)


def failure_of(error: BridgeError) -> Failure:
    """The failure that a refusal is."""
    said = error.args[0] if error.args else ""
    word = said.code if isinstance(said, Notice) else ""
    return Failure(
        code_of(word, CoapCode.CONFLICT if isinstance(error, Refused) else CoapCode.BAD_REQUEST),
        str(error),
        word,
    )


def code_of(word: str, other: CoapCode = CoapCode.CONFLICT) -> CoapCode:
    """CoAP's code for a refusal with that word; `other` for one without a code of its own."""
    return _CODES.get(word, other) if word else other  # type: ignore[call-overload]


def read_asked(request: Any) -> Asked:
    """What a request asks for; raises Failure for an option or a query that is not known."""
    for option in request.opt.option_list():
        number = option.number
        if number in (OptionNumber.PROXY_URI, OptionNumber.PROXY_SCHEME):
            raise failure("This robot is no proxy.", CoapCode.PROXYING_NOT_SUPPORTED)
        if number.is_critical() and number not in _KNOWN:
            raise failure(f"The option {int(number)} is not known.", CoapCode.BAD_OPTION)
    path = "/" + "/".join(request.opt.uri_path)
    links = path == "/.well-known/core"
    query = {} if links else _query(request.opt.uri_query)
    client = query.get("client", "")
    if len(client) > MAX_NAME or not client.isprintable():
        raise failure(f"A client's name has at most {MAX_NAME} characters that can be printed.")
    accept = request.opt.accept
    return Asked(
        path,
        tuple(sorted(request.opt.uri_query)),
        query.get("token", ""),
        client,
        _number(query, "stamp"),
        _number(query, "rate"),
        None if accept is None else int(accept),
    )


def _query(parts: tuple[str, ...]) -> dict[str, str]:
    query: dict[str, str] = {}
    for part in parts:
        key, _, value = part.partition("=")
        if key not in _QUERY or key in query:
            raise failure(f"A query has {', '.join(_QUERY)}, each once, not {part[:60]!r}.")
        query[key] = value
    return query


def _number(query: dict[str, str], key: str) -> float:
    if key not in query:
        return math.nan
    try:
        number = float(query[key])
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise failure(f"The {key} is a number, not {query[key][:60]!r}.")
    return number


def address_of(request: Any) -> str:
    """Where a request came from, as `HOST:PORT`."""
    return at_port(request.remote.host, request.remote.port)


def key_of_request(request: Any, asked: Asked) -> Hashable:
    """The same for all requests of one client about one content."""
    return request.remote.blockwise_key, request.code, asked.path, asked.query, asked.accept


def body_of(msg: Msg, asked: Asked) -> Body:
    """A message of the robot in the form that was asked for: JSON, but a picture as it is."""
    if isinstance(msg, CompressedImage) and asked.accept in (None, IMAGE):
        return Body(bytes(msg.data), IMAGE)
    return Body(to_json(msg), TEXT if asked.accept == TEXT else JSON)
