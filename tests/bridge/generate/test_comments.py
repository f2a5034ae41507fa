"""The comments of ROS text find the field that they are about."""

from __future__ import annotations

import pytest

from bridge.generate.comments import read_comments, unit_in, without_comment


def of(text: str, name: str) -> str:
    return read_comments(text).of[name]


def test_a_comment_behind_a_field_is_about_it():
    assert of("float64 depth  # Down from the surface [m].\n", "depth") == "Down from the surface [m]."


def test_it_goes_on_below_where_it_is_indented():
    text = "float64 depth  # Down from the surface,\n               # [m].\nfloat64 x\n"
    assert of(text, "depth") == "Down from the surface,\n[m]."
    assert of(text, "x") == ""


def test_a_comment_right_above_a_field_is_about_it():
    text = "float64 x\n# Down from the surface\n# [m].\nfloat64 depth\n"
    assert of(text, "depth") == "Down from the surface\n[m]."
    assert of(text, "x") == ""


def test_both_are_joined():
    assert of("# Down.\nfloat64 depth  # [m]\n", "depth") == "Down.\n[m]"


def test_what_comes_first_and_apart_is_about_the_whole():
    found = read_comments("# A boat.\n#\n# It floats.\n\nfloat64 depth\n")
    assert found.part == "A boat.\n\nIt floats."
    assert found.of == {"depth": ""}


def test_what_comes_first_right_above_a_constant_is_about_the_whole():
    found = read_comments(
        "# How full\n# it is.\nuint8 EMPTY=0  # Dry.\n# To the brim.\nuint8 FULL = 1\nuint8 level\n"
    )
    assert found.part == "How full\nit is."
    assert found.of == {"EMPTY": "Dry.", "FULL": "To the brim.", "level": ""}


def test_where_the_whole_has_its_word_a_comment_above_a_constant_is_about_that():
    found = read_comments("# A tank.\n\n# Dry.\nuint8 EMPTY=0\n")
    assert (found.part, found.of) == ("A tank.", {"EMPTY": "Dry."})


def test_a_comment_right_above_the_first_field_is_about_it():
    found = read_comments("# Down.\nfloat64 depth\nstring<=5 name\n")
    assert (found.part, found.of["depth"]) == ("", "Down.")


def test_a_later_comment_that_stands_apart_is_about_the_next_field():
    assert of("float64 x\n\n# Below are depths.\n\nfloat64 depth\n", "depth") == "Below are depths."


def test_what_comes_last_is_about_the_whole():
    assert read_comments("# A boat.\n\nfloat64 x\n# See the manual.\n").part == "A boat.\nSee the manual."


def test_a_message_without_fields_is_all_about_the_whole():
    assert read_comments("# Nothing\n# at all.\n").part == "Nothing\nat all."


def test_constants_arrays_and_bounds_are_named_as_fields_are():
    text = "uint8 OK=0  # Fine.\nstring<=5[<=3] names  # Of all.\ngeometry_msgs/Point[] at  # Where.\n"
    assert read_comments(text).of == {"OK": "Fine.", "names": "Of all.", "at": "Where."}


@pytest.mark.parametrize(
    ("line", "code", "comment"),
    [
        ('string name "a # b"  # c', 'string name "a # b"  ', "c"),
        ("string name 'a # b'", "string name 'a # b'", None),
        (r'string name "a \" # b"  # c', r'string name "a \" # b"  ', "c"),
        ("string NAME=a # b", "string NAME=a # b", None),
        ('string NAME="a" # b', 'string NAME="a" ', "b"),
        ("#", "", ""),
        ("", "", None),
    ],
)
def test_a_sign_within_a_text_begins_no_comment(line, code, comment):
    assert without_comment(line) == (code, comment)


@pytest.mark.parametrize(
    ("comment", "unit"),
    [
        ("[m/s]", "m/s"),
        ("Down from\nthe surface [m], positive.", "m"),
        ("3 x 3 [(rad/s)2]; a first element of -1 means none.", "(rad/s)2"),
        ("[m], again [m]", "m"),
        ("[degC]", "degC"),
        ("[%]", "%"),
        ("[m] or [rad]", ""),
        ("The camera matrix; k[0] of 0 means none, and a[i] too.", ""),
        ("In [0, 1].", ""),
        ("[x, y, z]", ""),
        ("[]", ""),
        ("", ""),
    ],
)
def test_a_unit_stands_in_square_brackets_and_two_are_none(comment, unit):
    assert unit_in(comment) == unit
