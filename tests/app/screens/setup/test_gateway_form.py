"""The form of a gateway's URL: what is typed is what the robot reads, and what is wrong is named."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.screens.setup.gateway_form import BadForm, GatewayForm
from robotside.gateways.discovery import adapters
from robotside.gateways.gateway_url import read_url

PORTS = {"mqtt": "1883", "mqtts": "8883", "own": "1883", "site": "0"}
SCHEMES = {name: int(port) for name, port in PORTS.items()}


def test_the_usual_url_of_each_protocol_comes_through_the_form_as_it_was() -> None:
    for adapter in adapters().values():
        ports = {scheme: str(port) for scheme, port in adapter.schemes.items()}
        url = GatewayForm.of(adapter.default).url(ports)
        assert read_url(url, adapter.schemes) == read_url(adapter.default, adapter.schemes), adapter.name


def test_what_is_typed_is_what_the_robot_reads() -> None:
    form = GatewayForm(
        "mqtts", " broker.example ", "", "/site a/", "anna", "p:a@s/s", "drive", "2.5", "arm, lights"
    )
    read = read_url(form.url(PORTS), SCHEMES)
    assert (read.scheme, read.host, read.port, read.path) == ("mqtts", "broker.example", 8883, "site a")
    assert (read.user, read.password) == ("anna", "p:a@s/s")
    assert read.role is not None
    assert (read.role.word, read.rate) == ("drive", 2.5)
    assert read.keys == {"robot", "arm", "lights"}
    assert read_url(GatewayForm("mqtt", "fe80::1", "7").url(PORTS), SCHEMES).address == "[fe80::1]:7"
    assert read_url(GatewayForm("site", path="api", role="watch").url(PORTS), SCHEMES).shown == "site:/api"


@pytest.mark.parametrize(
    ("field", "text", "words"),
    [
        ("host", "", "An address is a name or numbers"),
        ("host", "a b", "not 'a b'"),
        ("host", "me@there", "not 'me@there'"),
        ("port", "70000", "0 to 65535, not '70000'"),
        ("port", "x", "not 'x'"),
        ("rate", "0", "above 0 and at most 50 Hz, not '0'"),
        ("rate", "nan", "not 'nan'"),
        ("rate", "fast", "not 'fast'"),
    ],
)
def test_what_makes_no_url_is_named_with_its_field(field: str, text: str, words: str) -> None:
    form = replace(GatewayForm("mqtt", "broker", "1"), **{field: text})
    with pytest.raises(BadForm, match=words) as bad:
        form.url(PORTS)
    assert bad.value.field == field


def test_the_web_site_needs_a_path_and_what_cannot_be_read_is_an_empty_form() -> None:
    with pytest.raises(BadForm, match="A path of the robot's web site is needed"):
        GatewayForm("site").url(PORTS)
    assert GatewayForm.of("mqtt://host:port") == GatewayForm()
