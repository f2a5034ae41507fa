"""Forms of an answer: JSON, plain text or XML, as the request's Accept header prefers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import msgspec
from starlette.responses import Response
from starlette.types import Scope

from bridge.core.errors import BridgeError
from robotside.gateways.plain.visitor import refusal
from robotside.gateways.rest.statuses import Rejected, status_of

__all__ = ["EVENTS", "FORMS", "JSON", "TEXT", "XML", "chosen_form", "refused", "written"]

JSON, TEXT, XML = "application/json", "text/plain", "application/xml"
EVENTS = "text/event-stream"
FORMS = (JSON, TEXT, XML)
"""The first is what who says nothing gets."""
_ALIASES = {"text/xml": XML}
_FRESH = {"Cache-Control": "no-store", "X-Content-Type-Options": "nosniff"}
MAX_RANGES = 32
"""Entries of an Accept header that are read."""


def chosen_form(accept: str, offered: Sequence[str] = FORMS) -> str:
    """The form among `offered` that an Accept header prefers; Rejected (406) when it takes none of them."""
    best, most = "", 0.0
    ranges = list(_ranges(accept)) or [("*/*", 1.0)]
    for form in offered:
        matches = [(_match(named, form), quality) for named, quality in ranges]
        closeness, quality = max(matches)
        if not closeness:
            continue
        if quality > most:
            best, most = form, quality
    if not best:
        raise Rejected(406, f"This is answered as {', '.join(offered)}, not as {accept[:100]!r}.")
    return best


def _ranges(accept: str) -> Iterator[tuple[str, float]]:
    for each in accept.split(",")[:MAX_RANGES]:
        named, *options = (part.strip() for part in each.split(";"))
        quality = 1.0
        for option in options:
            if option.startswith("q="):
                try:
                    quality = float(option[2:])
                except ValueError:
                    quality = 0.0
        if named:
            yield _ALIASES.get(named.lower(), named.lower()), quality if 0 <= quality <= 1 else 0.0


def _match(named: str, form: str) -> int:
    """How closely a range of media types names a form; 0 when it does not."""
    if named == form:
        return 3
    if named == f"{form.partition('/')[0]}/*":
        return 2
    return 1 if named == "*/*" else 0


def written(form: str, body: bytes, status: int = 200, headers: dict[str, str] | None = None) -> Response:
    """An answer in a form, of its JSON `body`."""
    if form == TEXT:
        body = _text(msgspec.json.decode(body)).encode()
    elif form == XML:
        from robotside.gateways.rest.xml_form import to_xml  # its library is loaded for who asks for it

        body = to_xml(msgspec.json.decode(body))
    return Response(body, status, _FRESH | (headers or {}), media_type=form)


def refused(scope: Scope, status: int, error: BridgeError) -> Response:
    """The answer to a refused request in its own form; JSON where that is no form."""
    accept = b",".join(value for key, value in scope["headers"] if key == b"accept").decode("latin-1")
    try:
        form = chosen_form(accept)
    except Rejected:
        form = JSON
    headers = error.headers if isinstance(error, Rejected) else {}
    if status in (429, 503):
        headers = {"Retry-After": "5"} | headers
    if status == 401:
        headers = {"WWW-Authenticate": "Bearer"} | headers
    return written(form, refusal(error), status or status_of(error), headers)


def _text(value: Any, indent: str = "") -> str:
    """Lines of `name: value`; a list's parts each begin with a hyphen."""
    return "".join(f"{line}\n" for line in _lines(value, indent))


def _lines(value: Any, indent: str) -> Iterator[str]:
    if isinstance(value, dict):
        for key, part in value.items():
            if isinstance(part, (dict, list)) and part:
                yield f"{indent}{key}:"
                yield from _lines(part, f"{indent}  ")
            else:
                yield f"{indent}{key}: {_scalar(part)}"
    elif isinstance(value, list):
        for part in value:
            if isinstance(part, (dict, list)) and part:
                first, *rest = _lines(part, f"{indent}  ")
                yield f"{indent}- {first.strip()}"
                yield from rest
            else:
                yield f"{indent}- {_scalar(part)}"
    else:
        yield f"{indent}{_scalar(value)}"


def _scalar(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "unknown" if value is None else msgspec.json.encode(value).decode()
