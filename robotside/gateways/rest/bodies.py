"""Bodies and headers of requests: what form a body has, how long it may be, and when a command was meant."""

from __future__ import annotations

from typing import Any

from starlette.requests import Request

from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from robotside.gateways.http.presence import presence_of
from robotside.gateways.plain.stamps import read_stamp
from robotside.gateways.plain.strict_json import MAX_INPUT, decode
from robotside.gateways.rest.forms import JSON, XML
from robotside.gateways.rest.statuses import Rejected

__all__ = ["CLIENT_ID", "CLIENT_NAME", "KEY", "MAX_HEADER", "STAMP", "body_of", "header", "stamp_of"]

CLIENT_ID, CLIENT_NAME = "Client-Id", "Client-Name"
"""Who asks, where no key says it: an id that stays, and a name for people."""
KEY = "Idempotency-Key"
"""The `command_id`: a command that is sent again with it is done once and answered alike."""
STAMP = "Stamp"
"""When a command was meant, in seconds of the robot's time."""

_TYPES = {JSON: JSON, XML: XML, "text/xml": XML}
MAX_HEADER = 64
"""Characters of an id, a name or a key."""


async def body_of(request: Request, cls: type[Msg] | None) -> dict[str, Any]:
    """The object in a request's body, of a form that it names, `{}` for none.

    Refused for a request that has not counted any more since it began, as of `Presence`; a command is done without a pause after.
    Rejected for what is too long (413) or of another form (415), ProtocolError for what cannot be read. XML is read with
    the types of `cls`, and not at all without it.
    """
    raw = await _raw(request)
    presence_of(request.scope).check()
    if not raw.strip():
        return {}
    named = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    form = _TYPES.get(named)
    packed = request.headers.get("content-encoding", "").strip()
    if packed.lower() not in ("", "identity"):
        said = f"A body comes as it is, not {packed[:60]!r}."
        raise Rejected(415, said, {"Accept-Encoding": "identity"})
    if form == JSON:
        return decode(raw)
    if form is None or cls is None:
        forms = (JSON, XML) if cls else (JSON,)
        said = f"A body is {' or '.join(forms)} by its Content-Type, not {named[:60]!r}."
        raise Rejected(415, said, {"Accept": ", ".join(forms)})
    from robotside.gateways.rest.xml_form import from_xml  # its library is loaded for who sends it

    return from_xml(raw, cls)


async def _raw(request: Request) -> bytes:
    length = request.headers.get("content-length", "")
    raw = bytearray()
    if not (length.isdecimal() and int(length[:20]) > MAX_INPUT):
        async for piece in request.stream():
            raw += piece
            if len(raw) > MAX_INPUT:
                break
        else:
            return bytes(raw)
    raise Rejected(413, f"A body has at most {MAX_INPUT} bytes.")


def header(request: Request, name: str) -> str:
    """The value of a header that names somebody or something; empty without one. ProtocolError for what cannot be shown."""
    value = request.headers.get(name, "").strip()
    if len(value) > MAX_HEADER or not (value.isascii() and value.isprintable()):
        raise ProtocolError(f"The header {name} has at most {MAX_HEADER} letters, digits and signs of ASCII.")
    return value


def stamp_of(request: Request) -> float:
    """When a command was meant [s, operators' clock]; NaN where that is not said. ProtocolError for what is no time."""
    return read_stamp(request.headers.get(STAMP), f"header {STAMP}")
