"""Where events are sent, and where nobody has a robot knock."""

from __future__ import annotations

import pytest

from bridge.core.errors import ProtocolError, Refused
from bridge.core.identity import Role
from robotside.gateways.webhooks.targets import Asker, Target, check_address, read_target

NEAR = "192.0.2.7"


def test_the_parts_of_a_url_are_read() -> None:
    assert read_target("http://pc.lab:8000/hook?k=1") == Target(False, "pc.lab", 8000, "/hook?k=1")
    assert read_target("https://[2001:db8::1]") == Target(True, "2001:db8::1", 443, "/")
    assert read_target("https://[2001:db8::1]/secret").shown == "https://[2001:db8::1]:443"


@pytest.mark.parametrize(
    "url",
    [
        "",
        "pc.lab/hook",
        "ftp://pc.lab",
        "file:///etc/passwd",
        "http://",
        "http://pc.lab:0/",
        "http://pc.lab:99999/",
        "http://user@pc.lab/",
        "http://:secret@pc.lab/",
        "http://pc.lab/#part",
        "http://pc.lab/a b",
        "http://pc.lab/\r\nX: y",
        "http://pc.lab/\u00e9",
        "http://pc.lab/" + "x" * 1000,
    ],
)
def test_what_is_no_such_url_is_one_sentence(url: str) -> None:
    with pytest.raises(ProtocolError, match=r"^url .*\.$"):
        read_target(url)


@pytest.mark.parametrize(
    ("address", "asker", "role"),
    [
        (NEAR, NEAR, Role.DRIVE),
        (f"::ffff:{NEAR}", NEAR, Role.DRIVE),
        (NEAR, f"::ffff:{NEAR}", Role.DRIVE),
        ("127.0.0.1", "127.0.0.1", Role.DRIVE),
        ("10.1.2.3", NEAR, Role.MANAGE),
        ("2001:db8::1", NEAR, Role.MANAGE),
        ("127.0.0.1", "::1", Role.MANAGE),
    ],
)
def test_whom_events_are_sent_to(address: str, asker: str, role: Role) -> None:
    check_address(address, Asker(asker, role))


@pytest.mark.parametrize(
    ("address", "asker", "role", "said"),
    [
        ("10.1.2.3", NEAR, Role.DRIVE, "the address that you ask from"),
        ("127.0.0.1", NEAR, Role.DRIVE, "own machine"),
        ("127.0.0.1", NEAR, Role.MANAGE, "own machine"),
        ("127.8.8.8", NEAR, Role.MANAGE, "own machine"),
        ("::1", NEAR, Role.MANAGE, "own machine"),
        ("::ffff:127.0.0.1", NEAR, Role.MANAGE, "own machine"),
        ("169.254.169.254", NEAR, Role.MANAGE, "no address of one machine"),
        ("fe80::1", NEAR, Role.MANAGE, "no address of one machine"),
        ("0.0.0.0", "127.0.0.1", Role.MANAGE, "no address of one machine"),
        ("::", "127.0.0.1", Role.MANAGE, "no address of one machine"),
        ("224.0.0.251", NEAR, Role.MANAGE, "no address of one machine"),
        ("255.255.255.255", NEAR, Role.MANAGE, "no address of one machine"),
        ("240.0.0.1", NEAR, Role.MANAGE, "no address of one machine"),
    ],
)
def test_whom_they_are_not_sent_to(address: str, asker: str, role: Role, said: str) -> None:
    with pytest.raises(Refused, match=said):
        check_address(address, Asker(asker, role))
