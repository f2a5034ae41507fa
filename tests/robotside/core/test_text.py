"""What others send, and figures as people read them."""

from __future__ import annotations

import math

import pytest

from robotside.core.text import heading, number, plain


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


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (-3.25, "-3.2"),
        (999_999.0, "999999.0"),
        (1e6, "1e+06"),
        (-1e308, "-1e+308"),
        (math.inf, "inf"),
        (math.nan, "nan"),
    ],
)
def test_a_number_is_short_however_large_it_is(value: float, shown: str) -> None:
    assert number(value) == shown


def test_a_long_name_is_cut() -> None:
    assert plain("é" * 900_000, 40) == "é" * 40
    assert plain("a" * 39 + " b", 40) == "a" * 39


@pytest.mark.parametrize(
    ("yaw", "said"),
    [
        (0.0, "090°"),
        (math.pi / 2, "000°"),
        (math.pi / 2 + 0.004, "000°"),
        (-math.pi / 6, "120°"),
        (3 * math.pi, "270°"),
        (math.nan, "?"),
    ],
)
def test_a_heading_is_told_as_people_steer_by_it(yaw: float, said: str) -> None:
    assert heading(yaw) == said
