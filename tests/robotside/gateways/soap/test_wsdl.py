"""The WSDL: its parts fit together, and each operation has what its clients need."""

from __future__ import annotations

import pytest
from lxml import etree

from robotside.gateways.soap.operations import OPERATIONS, robot_contract, subscriber_contract
from robotside.gateways.soap.wsdl import BINDING, WSDL, Contract
from tests.looped import looped


@pytest.mark.parametrize("contract", [robot_contract(), subscriber_contract()], ids=lambda each: each.service)
def test_its_parts_name_each_other(contract: Contract) -> None:
    top = etree.fromstring(contract.wsdl("http://192.0.2.1/soap?a=1&b=<2>"))
    messages = {f"p:{each.get('name')}" for each in top.findall(f"{{{WSDL}}}message")}
    elements = {f"p:{each.get('name')}" for each in contract.schema if each.get("name")}
    assert {each.get("element") for each in top.iter(f"{{{WSDL}}}part")} <= elements
    named = {each.get("message") for each in top.iter() if each.get("message")}
    assert named <= messages
    (port,) = top.iter(f"{{{WSDL}}}port")
    (binding,) = top.iter(f"{{{WSDL}}}binding")
    assert port.get("binding") == f"p:{binding.get('name')}"
    assert binding.get("type") == f"p:{contract.service}"
    (address,) = top.iter(f"{{{BINDING}}}address")
    assert address.get("location") == "http://192.0.2.1/soap?a=1&b=<2>"


@looped("operation", OPERATIONS)
def test_each_operation_is_wrapped_and_says_what_it_does(operation: object) -> None:
    contract = robot_contract()
    names = [each.get("name") for each in contract.schema]
    assert {operation.name, f"{operation.name}Response"} <= set(names)  # type: ignore[attr-defined]
    assert operation.doc.endswith(".")  # type: ignore[attr-defined]


def test_no_two_elements_have_one_name() -> None:
    names = [(each.tag, each.get("name")) for each in robot_contract().schema]
    assert len(names) == len(set(names))
