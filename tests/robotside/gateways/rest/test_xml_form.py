"""XML of answers and requests; nothing that a document can do beside being read is done."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from lxml import etree

from bridge.codec import to_json
from bridge.core.errors import ProtocolError
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmOrder, SetPlaceRequest, SetScheduleRequest, TaskOrder, Waypoint
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.gateways.plain.strict_json import read_message
from robotside.gateways.rest.xml_form import from_xml, to_xml

BOMB = (
    b'<?xml version="1.0"?><!DOCTYPE lolz [<!ENTITY lol "lol">'
    + b"".join(
        b'<!ENTITY lol%d "%b">' % (n, b"&lol%b;" % (b"%d" % (n - 1) if n > 1 else b"") * 10)
        for n in range(1, 10)
    )
    + b"]><r><name>&lol9;</name></r>"
)


def read(raw: bytes, cls: type[Msg]) -> Msg:
    return read_message(from_xml(raw, cls), cls)


def test_values_have_the_types_of_their_fields() -> None:
    raw = b"""<order><pose>12</pose><point><x>1</x><y>-2.5e-1</y><z/></point>
        <angles><item>0.5</item><item>1</item></angles></order>"""
    found = from_xml(raw, ArmOrder)
    assert found == {"pose": "12", "point": {"x": 1, "y": -0.25, "z": None}, "angles": [0.5, 1]}
    order = read(raw, ArmOrder)
    assert isinstance(order, ArmOrder)
    assert list(order.angles) == [0.5, 1.0]


def test_lists_of_texts_messages_and_booleans_are_read() -> None:
    raw = b"<r><places><item>Office 1</item></places><goals><item><x>1</x></item></goals></r>"
    assert read(raw, TaskOrder) == TaskOrder(places=["Office 1"], goals=[Waypoint(x=1.0)])
    days = "".join(f"<item>{str(day < 5).lower()}</item>" for day in range(7))
    found = from_xml(f"<r><task><days>{days}</days></task></r>".encode(), SetScheduleRequest)
    assert found["task"]["days"] == [True] * 5 + [False] * 2
    assert from_xml(b"<r><data>aGk=</data></r>", CompressedImage) == {"data": "aGk="}


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("NaN", 'place.x must be a number or null, not "NaN"'),
        ("INF", 'not "INF"'),
        ("1e999", 'not "1e999"'),
        ("1_0", 'not "1_0"'),
        ("0x10", "not"),
        ("true", "not"),
        ("\u0661", "not"),
        ("<a/>", "must be a value"),
    ],
)
def test_what_is_no_number_is_named(value: str, said: str) -> None:
    with pytest.raises(ProtocolError, match=r"\.$") as error:
        read(f"<r><place><x>{value}</x></place></r>".encode(), SetPlaceRequest)
    assert said in str(error.value)


@pytest.mark.parametrize(
    ("raw", "said"),
    [
        (b"<r><place><lol>1</lol></place></r>", 'no field "place.lol"'),
        (b"<r>text<place/></r>", "not the text 'text'"),
        (b"<r><place/><place/></r>", "stands twice"),
        (b"<r><place/>text</r>", "not the text 'text'"),
        (b"<r><place><x>1</x> 2 <y/></place></r>", "not the text '2'"),
        (b"<r x='1'><place/></r>", "r has no attributes, not 'x'"),
        (b"<r><place><x unit='m'>1</x></place></r>", "x has no attributes, not 'unit'"),
        (b"<r><place>Office</place></r>", "not the text 'Office'"),
        (b"<r", "is not XML"),
        (b"{}", "is not XML"),
        (b"\xff\xfe", "is not XML"),
        (b"<r>" * 300 + b"</r>" * 300, "is not XML"),
        (b"<r xmlns='urn:x'><place/></r>", "no field"),
    ],
)
def test_what_is_no_message_is_refused_with_a_sentence(raw: bytes, said: str) -> None:
    with pytest.raises(ProtocolError, match=r"\.$") as error:
        read(raw, SetPlaceRequest)
    assert said in str(error.value)


def test_a_list_has_items(tmp_path: Path) -> None:
    with pytest.raises(ProtocolError, match="elements item"):
        from_xml(b"<r><places>Office</places></r>", TaskOrder)
    with pytest.raises(ProtocolError, match="elements item"):
        from_xml(b"<r><places><place>Office</place></places></r>", TaskOrder)


def test_entities_and_document_types_are_refused_and_nothing_is_fetched(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("hidden")
    for raw in (
        BOMB,
        f'<!DOCTYPE r [<!ENTITY x SYSTEM "file://{secret}">]><r><name>&x;</name></r>'.encode(),
        f'<!DOCTYPE r SYSTEM "file://{secret}"><r/>'.encode(),
        b"<!DOCTYPE r><r/>",
        '<!DOCTYPE r [<!ENTITY x "y">]><r/>'.encode("utf-16"),
    ):
        with pytest.raises(ProtocolError, match=r"document type|is not XML") as error:
            from_xml(raw, SetPlaceRequest)
        assert "hidden" not in str(error.value)


def test_an_answer_is_well_formed_whatever_is_in_it() -> None:
    message = json.loads(to_json(ArmOrder(pose="a<b>&\x00\ud7ff\ufffe", point=Point(1.0, 2.0, float("nan")))))
    root = etree.fromstring(to_xml(message))
    assert root.findtext("pose") == "a<b>&\ufffd\ud7ff\ufffd"
    assert root.findtext("point/x") == "1.0"
    assert root.findtext("point/z") == ""
    assert root.find("angles") is not None
    back = from_xml(to_xml(json.loads(to_json(TaskOrder(task="go_to", places=["A", "B"])))), TaskOrder)
    assert read_message(back, TaskOrder).places == ["A", "B"]
