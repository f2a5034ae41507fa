"""Fields of operations as dataclasses: their elements in XML Schema, and their values in XML and back.

A field is `str`, `bool`, `int`, `float` or a dataclass, optional as `X | None`, several as `tuple[X, ...]`, annotated with an
`About` that says what it is and what is allowed. `max_speed` is the element `maxSpeed`.
"""

from __future__ import annotations

import dataclasses
import math
import re
import types
import typing
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, TypeAlias, TypeVar, cast

from lxml import etree

__all__ = ["NS", "SOAP", "XS", "About", "Element", "Field", "fields_of", "named", "read", "schema", "written"]

NS = "urn:pilothouse:robot:1"
"""The namespace of all elements of a robot."""
SOAP = "http://schemas.xmlsoap.org/soap/envelope/"
XS = "http://www.w3.org/2001/XMLSchema"

Element: TypeAlias = Any
"""An element of lxml, which has no types."""
T = TypeVar("T")

_SIMPLE = {str: "string", bool: "boolean", int: "int", float: "double"}
_UNFIT = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML cannot carry."""


@dataclass(frozen=True, slots=True)
class About:
    """What a field is, and what is allowed."""

    doc: str = ""
    """With the unit."""
    least: float | None = None
    """Of a number, or characters of a text."""
    most: float | None = None
    """Of a number, or characters of a text."""
    count: int = 16
    """Most of those that come several times; 0 for any number."""
    words: tuple[str, ...] = ()
    """All that a text may be; empty for any."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field of a dataclass."""

    name: str
    """As in Python."""
    element: str
    """As in XML."""
    type: type
    """Of one value."""
    about: About
    optional: bool
    several: bool


def fields_of(cls: type) -> tuple[Field, ...]:
    """The fields of a dataclass."""
    return _fields_of(cls)


@lru_cache(maxsize=256)
def _fields_of(cls: type) -> tuple[Field, ...]:
    hints = typing.get_type_hints(cls, include_extras=True)
    return tuple(_field(each.name, hints[each.name]) for each in dataclasses.fields(cls))


def _field(name: str, hint: Any) -> Field:
    about, optional, several = About(), False, False
    if typing.get_origin(hint) is typing.Annotated:
        hint, about = typing.get_args(hint)
    if typing.get_origin(hint) in (types.UnionType, typing.Union):
        hint, optional = typing.get_args(hint)[0], True
    if typing.get_origin(hint) is tuple:
        hint, several = typing.get_args(hint)[0], True
    words = name.rstrip("_").split("_")
    element = words[0] + "".join(word.capitalize() for word in words[1:])
    return Field(name, element, hint, about, optional, several)


def named(name: str, namespace: str = NS) -> str:
    """The name of an element with its namespace."""
    return f"{{{namespace}}}{name}"


def schema(elements: dict[str, type]) -> Element:
    """The XML Schema of top elements, each with the fields of its dataclass."""
    top = etree.Element(named("schema", XS), nsmap={"xs": XS, "p": NS})
    top.set("targetNamespace", NS)
    top.set("elementFormDefault", "qualified")
    kinds: dict[type, None] = {}
    for name, cls in elements.items():
        _sequence(etree.SubElement(top, named("element", XS), name=name), cls, kinds)
    done: set[type] = set()
    while left := [cls for cls in kinds if cls not in done]:
        for cls in left:
            done.add(cls)
            _sequence(top, cls, kinds, cls.__name__)
    return top


def _sequence(parent: Element, cls: type, kinds: dict[type, None], name: str = "") -> None:
    kind = etree.SubElement(parent, named("complexType", XS))
    if name:
        kind.set("name", name)
    sequence = etree.SubElement(kind, named("sequence", XS))
    for field in fields_of(cls):
        element = etree.SubElement(sequence, named("element", XS), name=field.element)
        if field.optional or field.several:
            element.set("minOccurs", "0")
        if field.several:
            element.set("maxOccurs", str(field.about.count or "unbounded"))
        if field.about.doc:
            note = etree.SubElement(element, named("annotation", XS))
            etree.SubElement(note, named("documentation", XS)).text = field.about.doc
        if field.type in _SIMPLE:
            _simple(element, field)
        else:
            kinds[field.type] = None
            element.set("type", f"p:{field.type.__name__}")


def _simple(element: Element, field: Field) -> None:
    base, about = f"xs:{_SIMPLE[field.type]}", field.about
    facets = [("enumeration", word) for word in about.words]
    if field.type is str:
        facets += _facets("minLength", about.least) + _facets("maxLength", about.most)
    elif field.type is not bool:
        facets += _facets("minInclusive", about.least) + _facets("maxInclusive", about.most)
    if not facets:
        element.set("type", base)
        return
    kind = etree.SubElement(element, named("simpleType", XS))
    restriction = etree.SubElement(kind, named("restriction", XS), base=base)
    for facet, value in facets:
        etree.SubElement(restriction, named(facet, XS), value=value)


def _facets(name: str, value: float | None) -> list[tuple[str, str]]:
    return [] if value is None else [(name, f"{value:.15g}")]


def read(element: Element, cls: type[T]) -> T:
    """The value in an element that its schema holds for."""
    known = {named(field.element): field for field in fields_of(cls)}
    found: dict[str, Any] = {}
    for child in element:
        field = known[cast(str, child.tag)]
        value = _value(child, field.type)
        found[field.name] = (*found.get(field.name, ()), value) if field.several else value
    for field in known.values():
        found.setdefault(field.name, () if field.several else None)
    return cls(**found)


def _value(element: Element, kind: type) -> object:
    if kind not in _SIMPLE:
        return read(element, kind)
    text = "".join(cast("list[str]", list(element.itertext())))  # `text` ends where a comment was
    if kind is bool:
        return text.strip() in ("true", "1")
    return kind(text)


def written(name: str, value: object) -> Element:
    """A dataclass as an element of that name. A field that is None, or a number that is not known, is left out."""
    top = etree.Element(named(name), nsmap={"p": NS})
    _write(top, value)
    return top


def _write(parent: Element, value: object) -> None:
    for field in fields_of(type(value)):
        held = getattr(value, field.name)
        for each in held if field.several else (held,):
            if each is None or (isinstance(each, float) and math.isnan(each)):
                continue
            child = etree.SubElement(parent, named(field.element))
            if field.type in _SIMPLE:
                child.text = _text(each)
            else:
                _write(child, each)


def _text(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else "INF" if value > 0 else "-INF"
    return _UNFIT.sub("\ufffd", str(value))
