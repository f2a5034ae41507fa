"""Fields of operations: what their schema holds for, and values that come back as they went."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from robotside.gateways.soap.fields import NS, XS, About, fields_of, named, read, schema, written
from robotside.gateways.soap.messages import Caller
from robotside.gateways.soap.operations import OPERATIONS
from tests.looped import looped


@dataclass(frozen=True)
class Point:
    x: Annotated[float, About("east [m]", -10, 10)]
    note: str | None = None


@dataclass(frozen=True)
class Asked:
    is_quick: bool
    count: Annotated[int, About(least=0, most=5)]
    max_speed: Annotated[float | None, About("[m/s]", 0, 2)]
    kind: Annotated[str, About(words=("a", "b"))]
    point: Annotated[tuple[Point, ...], About(count=2)] = ()
    from_: Annotated[tuple[str, ...], About(most=3)] = ()


JUDGE = etree.XMLSchema(schema({"Asked": Asked}))


def element(inner: str) -> etree._Element:
    return etree.fromstring(f'<Asked xmlns="{NS}">{inner}</Asked>')


GOOD = "<isQuick>1</isQuick><count>3</count><kind>a</kind>"


def test_a_value_is_read_by_its_fields() -> None:
    asked = element(
        f"{GOOD}<point><x> 2.5 </x></point><point><x>-1</x><note>hm</note></point><from>ab</from>"
    )
    assert JUDGE.validate(asked)
    assert read(asked, Asked) == Asked(True, 3, None, "a", (Point(2.5), Point(-1.0, "hm")), ("ab",))


@looped(
    "inner",
    [
        "",
        GOOD.replace("1", "yes"),
        GOOD.replace("3", "6"),
        GOOD.replace("3", "2.5"),
        GOOD.replace("3", "-1"),
        GOOD.replace(">a<", ">c<"),
        f"{GOOD}<more/>",
        f"{GOOD}<from>long</from>",
        f"{GOOD}{'<point><x>1</x></point>' * 3}",
        *(
            f"{GOOD}<point><x>{word}</x></point>"
            for word in ("NaN", "INF", "-INF", "1e999", "11", "x", "0x1", "")
        ),
        f'{GOOD}<point xmlns:i="http://www.w3.org/2001/XMLSchema-instance" i:nil="true"/>',
        f'{GOOD}<point odd="1"><x>1</x></point>',
        f"{GOOD}words",
    ],
)
def test_the_schema_holds_for_nothing_else(inner: str) -> None:
    assert not JUDGE.validate(element(inner))


TEXT = st.text(st.characters(exclude_categories=["Cs", "Cc"], exclude_characters="\ufffe\uffff"), max_size=3)
NUMBER = st.floats(-10, 10)


@given(
    st.builds(
        Asked,
        st.booleans(),
        st.integers(0, 5),
        st.none() | st.floats(0, 2),
        st.sampled_from("ab"),
        st.lists(st.builds(Point, NUMBER, st.none() | TEXT), max_size=2).map(tuple),
        st.lists(TEXT, max_size=3).map(tuple),
    )
)
def test_what_is_written_is_valid_and_comes_back(value: Asked) -> None:
    there = etree.fromstring(etree.tostring(written("Asked", value)))
    assert JUDGE.validate(there), JUDGE.error_log
    back = read(there, Asked)
    assert back == value


def test_a_number_that_is_not_known_is_left_out_and_infinity_is_written_in_its_words() -> None:
    top = written("Asked", Asked(False, 0, math.nan, "a", (Point(math.inf), Point(-math.inf))))
    assert top.find(named("maxSpeed")) is None
    assert [x.text for x in top.iter(named("x"))] == ["INF", "-INF"]


def test_what_xml_cannot_carry_is_replaced() -> None:
    top = written("Point", Point(1.0, "a\x00\x1b\ufffe\ud800b\n"))
    assert top.findtext(named("note")) == "a\ufffd\ufffd\ufffd\ufffdb\n"


def _numbers(cls: type) -> list[str]:
    found = []
    for field in fields_of(cls):
        if field.type in (float, int) and None in (field.about.least, field.about.most):
            found.append(f"{cls.__name__}.{field.name}")
        elif field.type not in (float, int, str, bool):
            found += _numbers(field.type)
    return found


@pytest.mark.parametrize("cls", [Caller, *dict.fromkeys(each.request for each in OPERATIONS)])
def test_each_number_of_a_request_has_limits_so_that_none_is_infinite(cls: type) -> None:
    assert not _numbers(cls)


def test_a_field_has_the_type_of_one_value_and_a_name_as_in_xml() -> None:
    fields = {field.name: field for field in fields_of(Asked)}
    assert fields["is_quick"].element == "isQuick"
    assert fields["from_"].element == "from"
    assert (fields["point"].type, fields["point"].several) == (Point, True)
    assert (fields["max_speed"].type, fields["max_speed"].optional) == (float, True)
    assert get_args(Asked.__annotations__["count"]) == ()  # written as text until it is asked for


def test_the_schema_says_what_a_field_is() -> None:
    notes = [note.text for note in schema({"Asked": Asked}).iter(f"{{{XS}}}documentation")]
    assert "east [m]" in notes
