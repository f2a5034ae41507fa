"""Profiles as links: whole when they come back, refused in a sentence whatever a stranger makes of one."""

from __future__ import annotations

import base64
import zlib

import pytest

from app.layout.layout import load, names
from app.layout.layout_text import text_of
from app.profiles.profile_code import code_of
from app.profiles.profile_link import (
    MAX_CODE,
    MAX_LINK,
    BadProfileLink,
    fits_code,
    is_profile_link,
    link_of,
    text_of_link,
)
from widgets import CATALOGUE


def linked(content: bytes) -> str:
    return "pilothouse://layout?v=1&d=" + base64.urlsafe_b64encode(content).decode().rstrip("=")


@pytest.mark.parametrize("name", names())
def test_every_built_in_profile_comes_back_and_fits_into_one_code(name: str) -> None:
    text = text_of(load(name, CATALOGUE))
    link = link_of(text)
    assert text_of_link(f"  {link}\n") == text
    assert fits_code(link)
    rows = code_of(link)
    assert {len(row) for row in rows} == {len(rows)}


def test_the_longest_link_that_is_said_to_fit_into_a_code_does() -> None:
    assert len(code_of("pilothouse://layout?v=1&d=".ljust(MAX_CODE, "a"))) <= 177
    with pytest.raises(ValueError, match="does not fit into a QR code"):
        code_of("a" * 3000)


@pytest.mark.parametrize(
    ("link", "sentence"),
    [
        ("", "no link of a profile"),
        ("pilothouse://192.168.1.7:9090?n=Patrol-1", "no link of a profile"),
        ("https://layout?v=1&d=eA", "no link of a profile"),
        ("pilothouse://layout/other?v=1&d=eA", "no link of a profile"),
        ("pilothouse://layout?v=1", "no link of a profile"),
        ("pilothouse://layout?v=1&d=eA&x=1", "no link of a profile"),
        ("pilothouse://layout?" + "a=1&" * 9 + "a=1", "no link of a profile"),
        ("pilothouse://layout?v=2&d=eA", "made by a newer app"),
        ("pilothouse://layout?v=1&d=%%%", "not complete"),
        ("pilothouse://layout?v=1&d=äöü", "not complete"),
        (linked(b"no zlib"), "not complete"),
        (linked(zlib.compress(b"x" * 1000))[:-4], "not complete"),
        (linked(zlib.compress(b"\xff\xfe")), "not complete"),
        (linked(zlib.compress(b"x" * 50_000_000)), "more than 200 kB"),
        ("pilothouse://layout?v=1&d=".ljust(MAX_LINK + 1, "a"), "at most 100000 letters"),
    ],
)
def test_what_a_stranger_made_is_refused_in_a_sentence(link: str, sentence: str) -> None:
    with pytest.raises(BadProfileLink, match=sentence):
        text_of_link(link)


def test_a_link_is_told_from_the_path_of_a_file() -> None:
    assert is_profile_link(" pilothouse://layout?v=1&d=x")
    assert not is_profile_link("/home/me/layout.toml")
    assert not is_profile_link("pilothouse://192.168.1.7:9090")
