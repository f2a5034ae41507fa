"""The link to a robot without a secret, and that it is never taken for one with."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.trust.pairing import BadPairing, PairLink
from bridge.trust.robot_link import RobotLink, read_link
from tests.looped import looped

PAIRING = PairLink("192.0.2.7", 9090, "ab" * 32, "s" * 43, "Rex")


@given(
    st.sampled_from(["192.0.2.7", "rex.local", "2001:db8::7"]),
    st.integers(1, 65535),
    st.booleans(),
    st.text(st.characters(categories=["L", "N", "P", "Zs"]), max_size=40).filter(str.isprintable),
)
def test_what_is_written_is_read_back(host: str, port: int, secure: bool, name: str) -> None:
    link = RobotLink(host, port, secure, name)
    assert read_link(link.text) == link


def test_it_is_made_of_the_sockets_url_and_gives_it_back() -> None:
    for url in ("ws://192.0.2.7:9090", "wss://[2001:db8::7]:1"):
        assert RobotLink.of(url, "Rex").url == url


def test_a_link_with_a_secret_is_one_for_pairing() -> None:
    assert read_link(PAIRING.text) == PAIRING


@looped(
    "text",
    [
        "",
        "ws://192.0.2.7:9090",
        "https://192.0.2.7:9090?n=Rex",
        "pilothouse://",
        "pilothouse://192.0.2.7",
        "pilothouse://192.0.2.7:0?n=Rex",
        "pilothouse://192.0.2.7:99999?n=Rex",
        "pilothouse://192.0.2.7:9090/x?n=Rex",
        "pilothouse://a b:9090?n=Rex",
        "pilothouse://192.0.2.7:9090?n=Rex&n=Max",
        "pilothouse://192.0.2.7:9090?n=Rex&x=1",
        "pilothouse://192.0.2.7:9090?t=2&n=Rex",
        f"pilothouse://192.0.2.7:9090?n={'x' * 41}",
        "pilothouse://192.0.2.7:9090?n=a%0Ab",
        "pilothouse://192.0.2.7:9090?n=" + "x" * 600,
        PAIRING.text.replace("s=sss", "s=!!!"),
        PAIRING.text.replace("&s=", "&t="),
    ],
)
def test_any_other_text_is_refused(text: str) -> None:
    with pytest.raises(BadPairing, match="link of a robot"):
        read_link(text)


@given(st.text(max_size=700))
def test_whatever_a_qr_code_says_it_is_a_link_or_refused(text: str) -> None:
    for each in (text, f"pilothouse://{text}"):
        try:
            link = read_link(each)
        except BadPairing:
            continue
        assert link.host
        assert 0 < link.port < 65536
