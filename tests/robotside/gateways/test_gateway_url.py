"""URLs of gateways: each part read, each mistake one sentence that gives no password away."""

from __future__ import annotations

import pytest

from bridge.core.identity import Role
from robotside.gateways.gateway_url import SITE, GatewayUrl, read_url
from robotside.gateways.payloads.table import KEYS

SCHEMES = {"mqtt": 1883, "mqtts": 8883}
ON_SITE = {SITE: 0}


def test_all_parts_are_read() -> None:
    read = read_url("mqtts://anna:p%40ss@[::1]:99/lab/a/?role=drive&payloads=arm,laser&rate=2.5", SCHEMES)
    keys = frozenset({"robot", "arm", "laser"})
    assert read == GatewayUrl("mqtts", "::1", 99, "lab/a", "anna", "p@ss", Role.DRIVE, keys, 2.5)
    assert read.shown == "mqtts://[::1]:99/lab/a"


def test_what_is_left_out_has_its_usual_value() -> None:
    read = read_url("mqtt://broker.example", SCHEMES)
    assert (read.port, read.path, read.role, read.keys, read.rate) == (1883, "", None, KEYS, 5.0)
    assert read.shown == "mqtt://broker.example:1883"


WRONG = {
    "broker:1883": "written as mqtt://HOST:1883 or mqtts://HOST:8883",
    "http://broker": "not 'http://broker'",
    "mqtt://": "written as",
    "mqtt://u:secret@h:99999": "not 'mqtt://h:99999'",
    "mqtt://u:secret@h/#x": "not 'mqtt://h/#x'",
    "mqtt://h?role=boss": "A role is one of",
    "mqtt://h?role=manage": "none, watch or drive, not manage",
    "mqtt://h?payloads=claw": "There is no payload claw",
    "mqtt://h?rate=0": "above 0 and at most 50 Hz, not '0'",
    "mqtt://h?rate=nan": "not 'nan'",
    "mqtt://h?rate=51": "not '51'",
    "mqtt://h?speed=1": "The options of a URL are role, payloads, rate, not speed",
    "mqtt://h?rate=1&rate=2": "and each of them once",
}


@pytest.mark.parametrize("text", WRONG)
def test_a_mistake_is_one_sentence_without_a_password(text: str) -> None:
    with pytest.raises(ValueError, match=r"\.$") as error:
        read_url(text, SCHEMES)
    assert WRONG[text] in str(error.value)
    assert "secret" not in str(error.value)


def test_a_path_of_the_robots_own_web_site_has_options_and_no_address() -> None:
    read = read_url("site:/api/v2?role=drive&payloads=arm&rate=2", ON_SITE)
    assert read == GatewayUrl(
        SITE, "", 0, "api/v2", role=Role.DRIVE, keys=frozenset({"robot", "arm"}), rate=2.0
    )
    assert (read.shown, read.address) == ("site:/api/v2", "")


@pytest.mark.parametrize(
    "text",
    [
        "site:",
        "site:/",
        "site:api",
        "site:/api/",
        "site:/a b",
        "site:/..",
        "site:/./x",
        "site:/../../x",
        "site:/x/..",
        "site:/%41",
        "site://host/api",
        "site:/api#x",
    ],
)
def test_what_is_no_path_of_the_site_is_one_sentence(text: str) -> None:
    with pytest.raises(ValueError, match=r"written as site:/PATH, not .*\.$"):
        read_url(text, ON_SITE)


def test_a_gateway_that_listens_anywhere_has_no_path_of_the_site() -> None:
    with pytest.raises(ValueError, match="not 'site:/api'"):
        read_url("site:/api", SCHEMES)
