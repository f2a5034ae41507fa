"""XML of answers and of requests; no document type, no entities, nothing from elsewhere."""

from __future__ import annotations

import math
import re
from typing import Any

from lxml import etree

from bridge.codec.fields import Field, fields_of
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from robotside.gateways.plain.strict_xml import strict_parser

__all__ = ["from_xml", "to_xml"]

MAX_DEPTH = 32
"""Elements within each other; no message has as many."""
_UNWRITABLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_NUMBER = re.compile(r"-?(0|[1-9]\d*)(\.\d+)?([eE][+-]?\d+)?", re.ASCII)
_WHOLE = re.compile(r"-?(0|[1-9]\d*)", re.ASCII)
_TEXTS = ("string",)


def to_xml(value: Any) -> bytes:
    """An answer as the element `answer`; the parts of a list are elements `item`, what is not known is an empty one."""
    root = etree.Element("answer")
    _fill(root, value)
    written = etree.tostring(root, xml_declaration=True, encoding="UTF-8")
    return bytes(written)


def _fill(element: Any, value: Any) -> None:
    if isinstance(value, dict):
        for key, part in value.items():
            _fill(etree.SubElement(element, key), part)
    elif isinstance(value, list):
        for part in value:
            _fill(etree.SubElement(element, "item"), part)
    elif isinstance(value, bool):
        element.text = "true" if value else "false"
    elif value is not None:
        element.text = _UNWRITABLE.sub("\ufffd", str(value))


def from_xml(raw: bytes, cls: type[Msg]) -> dict[str, Any]:
    """What a request says, as decoded JSON with the types that the fields of `cls` have; ProtocolError for what is no XML.

    Fields that `cls` has not, and values that are not of their types, are left as they are, for who reads them strictly.
    """
    try:
        root = etree.fromstring(raw, strict_parser())
    except (etree.XMLSyntaxError, ValueError) as error:
        raise ProtocolError(f"The message is not XML: {str(error)[:200]}.") from error
    if root.getroottree().docinfo.internalDTD is not None:
        raise ProtocolError("The message has a document type, which is not taken: no DOCTYPE, no entities.")
    _check_whole(root)
    return _object(root, cls, 1)


def _check_whole(root: Any) -> None:
    """Raises ProtocolError for what a message has no place for: attributes, and text beside elements."""
    for element in root.iter():
        if element.attrib:
            raise ProtocolError(f"{element.tag} has no attributes, not {next(iter(element.attrib))[:60]!r}.")
        if (element.tail or "").strip():
            said = f"not the text {element.tail.strip()[:60]!r}"
            raise ProtocolError(f"Beside {element.tag} there are elements, {said}.")


def _object(element: Any, cls: type[Msg] | None, depth: int) -> dict[str, Any]:
    if depth > MAX_DEPTH:
        raise ProtocolError(f"The message is nested more than {MAX_DEPTH} deep.")
    if (element.text or "").strip():
        raise ProtocolError(f"{element.tag} must have elements, not the text {element.text.strip()[:60]!r}.")
    fields = {field.key: field for field in fields_of(cls)} if cls else {}
    found: dict[str, Any] = {}
    for child in element:
        if child.tag in found:
            raise ProtocolError(f"{child.tag} stands twice; the parts of a list are elements item within it.")
        found[child.tag] = _value(child, fields.get(child.tag), depth)
    return found


def _value(element: Any, field: Field | None, depth: int) -> Any:
    if field is None:
        return element.text or ""
    if not field.array or (field.base == "uint8" and not len(element)):
        return _one(element, field, depth)
    wrong = [child.tag for child in element if child.tag != "item"]
    if wrong or (element.text or "").strip():
        raise ProtocolError(f"{element.tag} must have elements item, one for each of its parts.")
    return [_one(child, field, depth + 1) for child in element]


def _one(element: Any, field: Field, depth: int) -> Any:
    if field.type is not None:
        return _object(element, field.type, depth + 1)
    if len(element):
        raise ProtocolError(f"{element.tag} must be a value, without elements.")
    text = element.text or ""
    if field.base in _TEXTS or (field.array and field.base == "uint8" and element.tag != "item"):
        return text
    return _typed(text.strip(), field.base)


def _typed(text: str, base: str) -> Any:
    """A number, true or false, null for nothing; the text itself where it is none of them."""
    if base == "bool":
        return {"true": True, "false": False}.get(text, text)
    if text in ("", "null"):
        return None
    if _WHOLE.fullmatch(text) and len(text) <= 20:
        return int(text)
    if _NUMBER.fullmatch(text) and len(text) <= 40 and math.isfinite(float(text)):
        return float(text)
    return text
