"""What is said about a TOML file with a fault: the line first of all."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec
import pytest

from bridge.core.toml_files import MAX_FAULTS, FileFault, read, read_all, text_of
from tests.looped import looped


class Leg(msgspec.Struct, forbid_unknown_fields=True):
    length: Annotated[float, msgspec.Meta(gt=0)]
    made_of: Literal["steel", "wood"] = "wood"


class Table(msgspec.Struct, forbid_unknown_fields=True):
    name: str
    legs: tuple[Leg, ...] = ()
    at: tuple[float, float] | None = None


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('name = "a"\nlegs = [{length = 0}]', "line 2: legs[0].length: must be a number above 0, not 0."),
        (
            'name = "a"\n[[legs]]\nmade_of = "tin"',
            "line 3: legs[0].made_of: must be one of steel, wood, not 'tin'.",
        ),
        ('name = "a"\n\n[[legs]]\nmade_of = "wood"', "line 3: legs[0].length: is missing."),
        (
            'name = "a"\n[[legs]]\nlength = inf',
            "line 3: legs[0].length: must be a number from -1e+09 to 1e+09, not inf.",
        ),
        (
            'name = "a"\nat = [\n0.0,\n-1e300]',
            "line 4: at[1]: must be a number from -1e+09 to 1e+09, not -1e+300.",
        ),
        ('name = "a"\nat = [nan, 0.0]', "line 2: at[0]: must be a number from -1e+09 to 1e+09, not nan."),
        ('name = "a"\nat = [1.0]', "line 2: at: must be a list of 2 numbers, not [1.0]."),
        ("name = 7", "line 1: name: must be a text in quotes, not 7."),
        ('name = "a"\ncolour = 1', "line 2: colour: is not known here."),
        ('name = "a"\nlegs = 1', "line 2: legs: must be a list of [[legs]] tables, not 1."),
        ('name = "a"\nname = "b"', "line 2: is not TOML: cannot overwrite a value where the file ends."),
        ('name = "a"\nlegs = [', "line 2: is not TOML: invalid value where the file ends."),
    ],
)
def test_a_fault_is_one_sentence_with_line_key_value_and_what_is_allowed(text: str, said: str) -> None:
    with pytest.raises(FileFault) as problem:
        read(text, Table, "my.toml")
    assert str(problem.value) == f"my.toml, {said}"


class Deep(msgspec.Struct, forbid_unknown_fields=True):
    number: float = 0.0
    lists: list[object] = []
    tables: tuple[Table, ...] = ()


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("lists = " + "[" * 3000 + "]" * 3000, "my.toml: is nested deeper than 32 levels."),
        ("number = 1" + "0" * 5000, "my.toml: is not TOML: exceeds the limit"),
        (
            "number = 1" + "0" * 400,
            "my.toml, line 1: number: must be a number that can be reckoned with, not 100",
        ),
        ("lists = [0x" + "f" * 5000 + "]", "not a number of thousands of digits."),
        ('"a\\nb" = 1', "my.toml, line 1: a b: is not known here."),
    ],
)
def test_what_no_program_can_read_is_one_line_too(text: str, said: str) -> None:
    with pytest.raises(FileFault) as problem:
        read(text, Deep, "my.toml")
    assert said in str(problem.value)
    assert "\n" not in str(problem.value)


def test_an_unknown_key_comes_with_those_that_there_are() -> None:
    with pytest.raises(FileFault) as problem:
        read('[[tables]]\nname = "a"\ncolour = 1', Deep, "my.toml")
    assert (problem.value.where, problem.value.known) == ("tables[0].colour", ("name", "legs", "at"))


def test_a_reader_may_allow_greater_numbers_but_none_that_is_infinite() -> None:
    assert read("number = 1e300", Deep, "my.toml", largest=math.inf).number == 1e300
    with pytest.raises(FileFault, match=r"number: must be a number, not inf\.$"):
        read("number = inf", Deep, "my.toml", largest=math.inf)


def test_what_is_missing_at_the_top_has_no_line() -> None:
    with pytest.raises(FileFault, match=r"^my\.toml: name: is missing\.$"):
        read("", Table, "my.toml")


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    for name, said in (
        ("none.toml", r"cannot be read \(No such file"),
        ("folder.toml", r"cannot be read \(Is a"),
    ):
        if name.startswith("folder"):
            (tmp_path / name).mkdir()
        with pytest.raises(FileFault, match=rf"{name}: {said}"):
            text_of(tmp_path / name)


def test_a_file_that_nobody_wrote_on_purpose_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "long.toml").write_bytes(b"#" * 1_000_001)
    with pytest.raises(FileFault, match="has more than 1,000,000 bytes"):
        text_of(tmp_path / "long.toml")


def test_every_fault_of_a_file_is_found_at_once_each_with_its_line() -> None:
    text = 'colour = "red"\nname = 3\n[[legs]]\nlength = 2.0\nmade_of = "tin"\n[[legs]]\nlength = 1e12\nshade = 1'
    found, faults = read_all(text, Table, "t.toml")
    assert found is None, "a length cannot be left out"
    assert [(one.line, one.where) for one in faults] == [
        (1, "colour"),
        (2, "name"),
        (5, "legs[0].made_of"),
        (7, "legs[1].length"),
        (8, "legs[1].shade"),
    ]


def test_what_is_right_of_a_file_is_read_beside_its_faults() -> None:
    found, faults = read_all("at = [1.0]\n[[legs]]\nlength = 2.0", Table, "t.toml")
    assert found == Table("", (Leg(2.0),))
    assert [one.where for one in faults] == ["name", "at"]


def test_a_file_that_is_no_toml_has_that_one_fault() -> None:
    found, faults = read_all("name = ", Table, "t.toml")
    assert (found, len(faults), faults[0].line) == (None, 1, 1)


def test_of_very_many_faults_the_first_are_told() -> None:
    text = 'name = "a"\n' + "\n".join(f"k{number} = 1" for number in range(500))
    _, faults = read_all(text, Table, "t.toml")
    assert len(faults) == MAX_FAULTS


@looped(
    "text",
    [
        "a." * 60_000 + "b = 1",
        "a = " + "[" * 60_000,
        "a = " + "{b = " * 40_000,
        "[" + ".".join("x" * 40) + "]",
    ],
)
def test_a_text_that_is_nested_too_deep_is_refused_before_it_is_read(text):
    with pytest.raises(FileFault, match="nested deeper than 32 levels|not TOML"):
        read(text, Any, "a file")


def test_a_long_word_is_no_depth():
    assert read("a = '" + "w" * 200_000 + "'\nb = 'Mr. A. B. Smith, at 1.5 m.'", Any, "a file")[
        "b"
    ].startswith("Mr.")
