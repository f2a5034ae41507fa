"""Links and codes: what a QR code and a person may say, and proofs that only the same certificate gives."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.trust.pairing import BadPairing, PairLink, code_in_groups, confirmations, sides, split_code

PRINT, SECRET = "ab" * 32, "s3cret_of-22-letters--"
LINK = PairLink("192.168.1.7", 9090, PRINT, SECRET, "Patrol-1 & Co")


@pytest.mark.parametrize("host", ["192.168.1.7", "patrol.local", "fe80::1", "127.0.0.1"])
def test_a_link_reads_as_it_was_written(host: str) -> None:
    link = PairLink(host, 9090, PRINT, SECRET, "Patröl-1 & Co?n=x")
    assert PairLink.read(f" {link.text}\n") == link


@pytest.mark.parametrize(
    "text",
    [
        "",
        "https://192.168.1.7:9090",
        "pilothouse://",
        "pilothouse://h",
        "pilothouse://h:99999999?c=1",
        "pilothouse://[x?c=1",
        LINK.text.replace("pilothouse", "http"),
        LINK.text.replace(PRINT, PRINT[:-1]),
        LINK.text.replace(PRINT, PRINT.upper()),
        LINK.text.replace(SECRET, "short"),
        LINK.text.replace(SECRET, "with space and more"),
        LINK.text.replace(":9090", ""),
        LINK.text.replace(":9090", ":0"),
        LINK.text.replace("192.168.1.7", "a b"),
        LINK.text + "&c=" + "cd" * 32,
        LINK.text.replace("n=", "n=%0A"),
        LINK.text + "x" * 1000,
    ],
)
def test_every_other_text_is_refused_in_one_sentence(text: str) -> None:
    with pytest.raises(BadPairing, match="no pairing link"):
        PairLink.read(text)


@given(st.text(max_size=200))
def test_no_text_of_a_qr_code_does_anything_else(rest: str) -> None:
    for text in (rest, f"pilothouse://{rest}", f"{LINK.text}{rest}"):
        try:
            assert PairLink.read(PairLink.read(text).text)
        except BadPairing:
            continue


def test_a_code_is_read_as_people_type_it() -> None:
    assert split_code("123456") == ("", "123456")
    assert split_code(" 123 456 ") == ("", "123456")
    assert split_code("42-012-345") == ("42", "012345")


@pytest.mark.parametrize("text", ["", "12345", "1234567", "123456789", "12345a", "١٢٣٤٥٦"])
def test_what_is_no_code_is_refused(text: str) -> None:
    with pytest.raises(BadPairing, match="6 digits"):
        split_code(text)


def test_another_certificate_gives_other_sides() -> None:
    assert len({*sides(PRINT), *sides("cd" * 32)}) == 4


def test_each_side_and_each_key_confirms_differently() -> None:
    assert len({*confirmations(b"one"), *confirmations(b"two")}) == 4


def test_a_code_is_shown_in_groups_and_read_so() -> None:
    for code, groups in (("123456", "123 456"), ("42123456", "42 123 456")):
        assert code_in_groups(code) == groups
        assert "".join(split_code(groups)) == code
