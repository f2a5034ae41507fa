"""The WSDL of a service: its operations, document/literal wrapped, with the XML Schema of all that goes to and fro."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from lxml import etree

from robotside.gateways.soap.fields import NS, XS, Element, named, schema

__all__ = ["CALLER", "REFUSAL", "Contract", "Operation", "contract"]

WSDL = "http://schemas.xmlsoap.org/wsdl/"
BINDING = "http://schemas.xmlsoap.org/wsdl/soap/"
HTTP = "http://schemas.xmlsoap.org/soap/http"

CALLER, REFUSAL = "Caller", "Refusal"
"""The elements of the header that says who calls, and of a fault's detail."""


@dataclass(frozen=True, slots=True)
class Operation:
    """One operation of a service."""

    name: str
    """As in `GetPose`; also the element of its request."""
    doc: str
    request: type
    response: type

    @property
    def action(self) -> str:
        """Its SOAPAction."""
        return f"{NS}#{self.name}"


@dataclass(frozen=True, slots=True)
class Contract:
    """A service as its clients see it."""

    service: str
    operations: Sequence[Operation]
    caller: type
    refusal: type
    schema: Element
    """XML Schema of all top elements."""

    def judge(self) -> etree.XMLSchema:
        """A validator of what comes and goes."""
        return etree.XMLSchema(self.schema)

    def wsdl(self, location: str) -> bytes:
        """The WSDL, with the URL where the service is."""
        return bytes(etree.tostring(_definitions(self, location), xml_declaration=True, encoding="utf-8"))


def contract(service: str, operations: Sequence[Operation], caller: type, refusal: type) -> Contract:
    """The contract of a service with these operations."""
    elements: dict[str, type] = {CALLER: caller, REFUSAL: refusal}
    for each in operations:
        elements |= {each.name: each.request, f"{each.name}Response": each.response}
    return Contract(service, operations, caller, refusal, schema(elements))


def _definitions(asked: Contract, location: str) -> Element:
    top = etree.Element(named("definitions", WSDL), nsmap={None: WSDL, "soap": BINDING, "xs": XS, "p": NS})
    top.set("targetNamespace", NS)
    top.set("name", asked.service)
    types = etree.SubElement(top, named("types", WSDL))
    types.append(_copy(asked.schema))
    for name in (CALLER, REFUSAL):
        _message(top, name, name, "detail" if name == REFUSAL else "caller")
    for each in asked.operations:
        _message(top, each.name, each.name)
        _message(top, f"{each.name}Response", f"{each.name}Response")
    _port_type(top, asked)
    _binding(top, asked)
    service = etree.SubElement(top, named("service", WSDL), name=asked.service)
    port = etree.SubElement(service, named("port", WSDL), name=f"{asked.service}Port")
    port.set("binding", f"p:{asked.service}Binding")
    etree.SubElement(port, named("address", BINDING), location=location)
    return top


def _copy(element: Element) -> Element:
    return etree.fromstring(etree.tostring(element))


def _message(top: Element, name: str, element: str, part: str = "parameters") -> None:
    message = etree.SubElement(top, named("message", WSDL), name=f"{name}Message")
    etree.SubElement(message, named("part", WSDL), name=part, element=f"p:{element}")


def _port_type(top: Element, asked: Contract) -> None:
    kind = etree.SubElement(top, named("portType", WSDL), name=asked.service)
    for each in asked.operations:
        operation = etree.SubElement(kind, named("operation", WSDL), name=each.name)
        etree.SubElement(operation, named("documentation", WSDL)).text = each.doc
        etree.SubElement(operation, named("input", WSDL), message=f"p:{each.name}Message")
        etree.SubElement(operation, named("output", WSDL), message=f"p:{each.name}ResponseMessage")
        etree.SubElement(operation, named("fault", WSDL), name=REFUSAL, message=f"p:{REFUSAL}Message")


def _binding(top: Element, asked: Contract) -> None:
    binding = etree.SubElement(top, named("binding", WSDL), name=f"{asked.service}Binding")
    binding.set("type", f"p:{asked.service}")
    etree.SubElement(binding, named("binding", BINDING), style="document", transport=HTTP)
    for each in asked.operations:
        operation = etree.SubElement(binding, named("operation", WSDL), name=each.name)
        etree.SubElement(operation, named("operation", BINDING), soapAction=each.action, style="document")
        into = etree.SubElement(operation, named("input", WSDL))
        etree.SubElement(
            into, named("header", BINDING), message=f"p:{CALLER}Message", part="caller", use="literal"
        )
        etree.SubElement(into, named("body", BINDING), parts="parameters", use="literal")
        out = etree.SubElement(operation, named("output", WSDL))
        etree.SubElement(out, named("body", BINDING), use="literal")
        fault = etree.SubElement(operation, named("fault", WSDL), name=REFUSAL)
        etree.SubElement(fault, named("fault", BINDING), name=REFUSAL, use="literal")
