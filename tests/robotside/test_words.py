"""What others call things."""

from __future__ import annotations

import pytest

from robotside.words import plain


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("tablet-B", "tablet-B"),
        ("Zoë's Gerät 漢字 🤖", "Zoë's Gerät 漢字 🤖"),
        ("two\r\nlines\tand  more\u2028yet", "two lines and more yet"),
        ("\x1b[31mred\x00\x7f", "[31mred"),
        ("ab\u202ecd\u200f\ufeff", "abcd"),
        (" \n ", ""),
    ],
)
def test_a_name_is_one_line_of_printable_characters(text: str, shown: str) -> None:
    assert plain(text, 40) == shown


def test_a_long_name_is_cut() -> None:
    assert plain("é" * 900_000, 40) == "é" * 40
    assert plain("a" * 39 + " b", 40) == "a" * 39
