"""Envelopes: what a client sends is read strictly, without entities, document types or the network; answers and faults.

A message is judged by the XML Schema of the service before anything of it counts.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass

from lxml import etree

from bridge.core.errors import BridgeError, ProtocolError
from robotside.core.notice import Notice
from robotside.gateways.plain.strict_json import MAX_INPUT
from robotside.gateways.plain.strict_xml import strict_parser
from robotside.gateways.soap.fields import NS, SOAP, Element, named, written
from robotside.gateways.soap.messages import Refusal
from robotside.gateways.soap.wsdl import CALLER, REFUSAL

__all__ = [
    "CLIENT",
    "CONTENT_TYPE",
    "SERVER",
    "STOP",
    "Asked",
    "EnvelopeError",
    "envelope",
    "fault",
    "read_envelope",
    "stops",
]

CONTENT_TYPE = "text/xml; charset=utf-8"
CLIENT, SERVER, VERSION, UNDERSTAND = "Client", "Server", "VersionMismatch", "MustUnderstand"
"""Who is at fault, in the words of SOAP."""

STOP = "Stop"
"""The operation that is done for anyone."""

_NAMESPACE = re.compile(r"\{[^{}]*\}")
_DOCTYPE = re.compile(rb"<!\s*(DOCTYPE|ENTITY)", re.IGNORECASE)
_ENCODING = re.compile(rb"""(?:\xef\xbb\xbf)?\s*<\?xml[^>]*?\sencoding\s*=\s*["']([^"']*)["']""")
_MAX_SAID = 400
"""Characters kept of what the schema says."""


class EnvelopeError(ProtocolError):
    """An envelope that cannot be answered as it stands."""

    def __init__(self, sentence: str, code: str = CLIENT) -> None:
        """`code` is SOAP's word for the kind."""
        super().__init__(sentence)
        self.code = code


@dataclass(frozen=True, slots=True)
class Asked:
    """What a client asks, valid by the schema."""

    operation: str
    body: Element
    caller: Element | None
    """The header that says who calls; None without one."""


def read_envelope(raw: bytes, judge: etree.XMLSchema, operations: Collection[str]) -> Asked:
    """What an envelope asks, one of the `operations`. Raises ProtocolError with one sentence that says what is wrong."""
    top = _parsed(raw)
    declared = _ENCODING.match(raw)
    if declared and declared[1].lower() not in (b"utf-8", b"utf8", b"us-ascii"):
        raise EnvelopeError(f"A message is written in UTF-8, not {declared[1].decode()[:30]!r}.")
    if top.tag != named("Envelope", SOAP):
        if etree.QName(top).localname == "Envelope":
            raise EnvelopeError(f"Envelopes are those of SOAP 1.1, {SOAP}.", VERSION)
        raise EnvelopeError(f"A message is an Envelope of SOAP 1.1, not {_shown(top)}.")
    parts = list(top)
    header = parts.pop(0) if parts and parts[0].tag == named("Header", SOAP) else None
    if len(parts) != 1 or parts[0].tag != named("Body", SOAP) or len(parts[0]) != 1:
        raise EnvelopeError("An envelope has at most one Header, and one Body with one element.")
    body = parts[0][0]
    if body.tag not in map(named, operations):
        raise EnvelopeError(
            f"There is no operation {_shown(body)} of {NS}; there are {', '.join(operations)}."
        )
    _check(body, judge)
    return Asked(etree.QName(body).localname, body, _caller(header, judge))


def _parsed(raw: bytes) -> Element:
    if len(raw) > MAX_INPUT:
        raise EnvelopeError(f"A message has at most {MAX_INPUT} bytes, not {len(raw)}.")
    if _DOCTYPE.search(raw):
        raise EnvelopeError("A message has no document type and no entities of its own.")
    try:
        raw.decode()
    except UnicodeDecodeError as error:
        raise EnvelopeError("A message is written in UTF-8.") from error
    # in UTF-8 whatever it says itself: a document type cannot hide in another encoding
    parser = strict_parser("utf-8")
    try:
        top = etree.fromstring(raw, parser)
    except etree.XMLSyntaxError as error:
        raise EnvelopeError(f"The message is not XML: {error.msg}.") from error
    if top.getroottree().docinfo.internalDTD is not None:
        raise EnvelopeError("A message has no document type and no entities of its own.")
    return top


def _caller(header: Element | None, judge: etree.XMLSchema) -> Element | None:
    """The header that is ours; others are passed over unless they must be understood."""
    found = None
    for each in () if header is None else header:
        if each.tag == named(CALLER) and found is None:
            found = each
            _check(each, judge)
        elif each.tag == named(CALLER) or each.get(named("mustUnderstand", SOAP), "0") not in ("0", "false"):
            raise EnvelopeError(f"The header {_shown(each)} is not understood, or there twice.", UNDERSTAND)
    return found


def _check(element: Element, judge: etree.XMLSchema) -> None:
    """Raises EnvelopeError for what the schema does not hold for."""
    for name in (named("mustUnderstand", SOAP), named("actor", SOAP)):
        element.attrib.pop(name, None)  # words for SOAP itself
    if judge.validate(element):
        return
    problem = judge.error_log[0].message
    raise EnvelopeError(_NAMESPACE.sub("", problem)[:_MAX_SAID].rstrip(". ") + ".")


def _shown(element: Element) -> str:
    return repr(etree.QName(element).localname[:60])


def envelope(content: Element) -> bytes:
    """An envelope round an answer or a fault."""
    top = etree.Element(named("Envelope", SOAP), nsmap={"soap": SOAP})
    etree.SubElement(top, named("Body", SOAP)).append(content)
    return bytes(etree.tostring(top, xml_declaration=True, encoding="utf-8"))


def fault(error: BridgeError, code: str = CLIENT) -> bytes:
    """The envelope that says why something is not done, with its code where it has one."""
    said = error.args[0] if error.args else ""
    word = error.code if isinstance(error, EnvelopeError) else code
    top = etree.Element(named("Fault", SOAP), nsmap={"soap": SOAP, "p": NS})
    etree.SubElement(top, "faultcode").text = f"soap:{word}"
    refusal = Refusal(code=said.code if isinstance(said, Notice) else "", message=str(error))
    detail = written(REFUSAL, refusal)
    etree.SubElement(top, "faultstring").text = detail[-1].text
    etree.SubElement(top, "detail").append(detail)
    return envelope(top)


def stops(raw: bytes) -> bool:
    """The message asks for STOP, whatever else is wrong with it."""
    try:
        top = _parsed(raw)
    except EnvelopeError:
        return False
    asked = (child for part in top if part.tag == named("Body", SOAP) for child in part)
    return any(child.tag == named(STOP) for child in asked)
