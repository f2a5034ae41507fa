"""Forms of answers: which one an Accept header prefers, and how each is written."""

from __future__ import annotations

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.core.notice import Notice
from robotside.gateways.rest.forms import EVENTS, FORMS, JSON, TEXT, XML, chosen_form, refused, written
from robotside.gateways.rest.statuses import Rejected


@pytest.mark.parametrize(
    ("accept", "form"),
    [
        ("", JSON),
        ("*/*", JSON),
        ("application/json", JSON),
        ("APPLICATION/JSON", JSON),
        ("text/plain", TEXT),
        ("text/xml", XML),
        ("application/xml;q=0.9, application/json;q=0.1", XML),
        ("text/*;q=0.3, application/*;q=0.2", TEXT),
        ("application/json;q=0, */*", TEXT),
        ("text/html, */*;q=0.1", JSON),
        ("image/png, text/plain;q=bad, application/xml", XML),
    ],
)
def test_the_form_is_the_one_that_is_preferred(accept: str, form: str) -> None:
    assert chosen_form(accept) == form


@pytest.mark.parametrize(
    "accept", ["image/png", "application/json;q=0", "text/event-stream", ";;,", "image/*, text/html"]
)
def test_where_none_is_taken_that_is_said(accept: str) -> None:
    if not accept.strip(";,"):
        assert chosen_form(accept) == JSON
        return
    with pytest.raises(
        Rejected, match="answered as application/json, text/plain, application/xml, not as"
    ) as error:
        chosen_form(accept)
    assert error.value.status == 406


def test_events_are_offered_where_there_are_any() -> None:
    assert chosen_form("text/event-stream", (*FORMS, EVENTS)) == EVENTS
    assert chosen_form("*/*", (*FORMS, EVENTS)) == JSON


BODY = b'{"name":"A","x":1.5,"yaw":null,"on":true,"tags":["a","b"],"none":[],"parts":[{"k":1,"v":"x"},{"k":2,"v":"y"}]}'


def test_text_has_a_line_for_each_value() -> None:
    text = bytes(written(TEXT, BODY).body).decode()
    assert text.splitlines() == [
        "name: A",
        "x: 1.5",
        "yaw: unknown",
        "on: true",
        "tags:",
        "  - a",
        "  - b",
        "none: []",
        "parts:",
        "  - k: 1",
        "    v: x",
        "  - k: 2",
        "    v: y",
    ]


def test_a_refusal_has_its_code_in_every_form_and_is_never_kept() -> None:
    error = Refused(Notice(Code.STOP_IS_PRESSED, "STOP is <pressed>."))
    for accept, body in (
        (b"application/json", b'{"success":false,"message":"STOP is <pressed>.","code":"stop_is_pressed"}'),
        (b"text/plain", b"success: false\nmessage: STOP is <pressed>.\ncode: stop_is_pressed\n"),
        (b"image/png", b'{"success":false,"message":"STOP is <pressed>.","code":"stop_is_pressed"}'),
    ):
        answer = refused({"headers": [(b"accept", accept)]}, 409, error)
        assert (answer.status_code, answer.body) == (409, body)
        assert answer.headers["cache-control"] == "no-store"
    xml = bytes(refused({"headers": [(b"accept", b"text/xml")]}, 409, error).body)
    assert b"<success>false</success><message>STOP is &lt;pressed&gt;.</message>" in xml
