"""Envelopes: nothing is read of one that could reach out, and a STOP is seen in whatever can be read."""

from __future__ import annotations

import http.server
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest
from lxml import etree

from bridge.core.codes import Code
from bridge.core.errors import ProtocolError, Refused
from robotside.core.notice import Notice
from robotside.gateways.soap.envelope import SERVER, envelope, fault, read_envelope, stops
from robotside.gateways.soap.fields import NS, SOAP
from robotside.gateways.soap.operations import robot_contract
from tests.looped import looped
from tests.robotside.gateways.soap.served import body, message

CONTRACT = robot_contract()
JUDGE = CONTRACT.judge()
NAMES = [each.name for each in CONTRACT.operations]


def asked(raw: str | bytes) -> object:
    return read_envelope(raw if isinstance(raw, bytes) else raw.encode(), JUDGE, NAMES)


@pytest.fixture
def elsewhere() -> Iterator[tuple[str, list[str]]]:
    """A web server that notes what it is asked for."""
    heard: list[str] = []

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            heard.append(self.path)
            self.send_error(404)

        def log_message(self, *_: object) -> None:
            pass

    server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}", heard
    server.shutdown()
    thread.join()
    server.server_close()


def test_nothing_is_fetched_whatever_a_message_names(
    elsewhere: tuple[str, list[str]], tmp_path: Path
) -> None:
    where, heard = elsewhere
    secret = tmp_path / "secret"
    secret.write_text("s3cret")
    inner = body("GetMessage", topic="/odom").replace("/odom", "&e;")
    for entity in (f'SYSTEM "{where}/e"', f'SYSTEM "{secret.as_uri()}"', f'PUBLIC "-//x" "{where}/p"'):
        for doctype in (f"<!DOCTYPE x [<!ENTITY e {entity}>]>", f'<!DOCTYPE x SYSTEM "{where}/dtd">'):
            with pytest.raises(ProtocolError, match="no document type") as problem:
                asked(doctype + message(inner))
            assert "s3cret" not in str(problem.value)
    include = f'<x:include xmlns:x="http://www.w3.org/2001/XInclude" href="{secret.as_uri()}" parse="text"/>'
    with pytest.raises(ProtocolError, match="topic") as problem:
        asked(message(inner.replace("&e;", include)))
    assert "s3cret" not in str(problem.value)
    hint = f'xmlns:i="http://www.w3.org/2001/XMLSchema-instance" i:schemaLocation="urn:x {where}/xsd"'
    asked(message(body("GetInfo")).replace("<GetInfo", f"<GetInfo {hint}", 1))
    assert not heard


@looped("doctype", ["<!DOCTYPE x>", "<!doctype x>", "<! DOCTYPE x>", "<!ENTITY a 'b'>", "<!--<!DOCTYPE-->"])
def test_a_document_type_is_refused_wherever_it_stands(doctype: str) -> None:
    for raw in (doctype + message(body("GetInfo")), message(body("GetInfo")) + doctype):
        with pytest.raises(ProtocolError, match="no document type"):
            asked(raw)
        assert not stops(raw.replace("GetInfo", "Stop").encode())


@looped("encoding", ["utf-16", "utf-32", "utf-7", "cp037"])
def test_no_other_encoding_hides_one(encoding: str) -> None:
    declared = f'<?xml version="1.0" encoding="{encoding}"?><!DOCTYPE x [<!ENTITY e "Lab">]>'
    raw = (declared + message(body("GoTo", place="Lab").replace("Lab", "&e;"))).encode(encoding)
    with pytest.raises(ProtocolError):
        asked(raw)


@looped("encoding", ["iso-8859-1", "utf-16", "windows-1252"])
def test_a_message_that_names_another_encoding_is_refused_and_a_stop_is_heard(encoding: str) -> None:
    declared = f"<?xml version='1.0' encoding=\"{encoding}\"?>"
    with pytest.raises(ProtocolError, match=f"written in UTF-8, not '{encoding}'"):
        asked(declared + message(body("GetInfo")))
    assert stops((declared + message(body("Stop"))).encode())
    for known in ("UTF-8", "utf-8", "us-ascii"):
        asked(declared.replace(encoding, known) + message(body("GetInfo")))


@looped("depth", [300, 5000])
def test_a_deep_message_is_refused(depth: int) -> None:
    with pytest.raises(ProtocolError):
        asked(message("<a>" * depth + "</a>" * depth))


@looped(
    ("raw", "there"),
    [
        (message(body("Stop")), True),
        (message(body("Stop", more=1)), True),
        (message(body("GetPose") + body("Stop")), True),
        (message(body("GetPose")), False),
        (message(f'<a xmlns="{NS}"><Stop/></a>'), False),
        (message("<Stop xmlns='urn:other'/>"), False),
        (message(body("Stop"))[:-5], False),
        ("", False),
    ],
)
def test_a_stop_is_seen(raw: str, there: bool) -> None:
    assert stops(raw.encode()) is there


def test_a_refusal_carries_its_sentence_and_code() -> None:
    said = Notice(Code.PLACE_UNKNOWN, "There is no place 'a<b\x00'.", place="a")
    top = etree.fromstring(fault(Refused(said)))[0][0]
    assert top.findtext("faultcode") == "soap:Client"
    assert top.findtext("faultstring") == "There is no place 'a<b\ufffd'."
    detail = top.find("detail")[0]
    assert JUDGE.validate(etree.fromstring(etree.tostring(detail)))
    assert detail[0].text == Code.PLACE_UNKNOWN.value
    assert b"soap:Server" in fault(Refused("No."), SERVER)


def test_an_envelope_has_a_body() -> None:
    top = etree.fromstring(envelope(etree.Element("x")))
    assert (top.tag, top[0].tag, top[0][0].tag) == (f"{{{SOAP}}}Envelope", f"{{{SOAP}}}Body", "x")
