"""What is said about a TOML file with a fault: the line first of all."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import msgspec
import pytest

from bridge.core.toml_files import FileFault, line_of, read, text_of
from sim.payloads import load as load_payloads
from sim.vehicles.parameters import load as load_parameters
from sim.vehicles.patrol import PatrolParameters
from sim.world.world_files import WorldError, load

TEXT = '''\
# a comment with [brackets] and x = 1
name = "yard"
words = """
[not.a.table]
x = 7
"""
sizes = [
    1.0,
    2.0,  # the second
    3.0,
]
near.x = 1

[ground]
length = 3.0

[[cars]]
x = 1

[[cars]]      # the second one
x = 2
colour = [1,
  2, 3]

[cars.door]
open = true

[[cars.wheels]]
size = 0.5

[[cars.wheels]]
size = 0.6

[[cars]]
points = [
  {x = 1, y = 2},

  {x = 3, y = 4},
]
'''


@pytest.mark.parametrize(
    ("where", "line"),
    [
        ("name", 2),
        ("words", 3),
        ("sizes", 7),
        ("sizes[1]", 9),
        ("near.x", 12),
        ("ground", 14),
        ("ground.length", 15),
        ("ground.width", 14),
        ("cars[0].x", 18),
        ("cars[1]", 20),
        ("cars[1].x", 21),
        ("cars[1].colour", 22),
        ("cars[1].door.open", 26),
        ("cars[1].wheels[0].size", 29),
        ("cars[1].wheels[1].size", 32),
        ("cars[2].points[0]", 36),
        ("cars[2].points[1].y", 38),
        ("nothing", 0),
        ("", 0),
    ],
)
def test_a_key_is_found_in_its_line(where: str, line: int) -> None:
    assert line_of(TEXT, where) == line


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
        ('name = "a"\nat = [1.0]', "line 2: at: must be a list of 2, not [1.0]."),
        ("name = 7", "line 1: name: must be a text in quotes, not 7."),
        ('name = "a"\ncolour = 1', "line 2: colour: is not known here."),
        ('name = "a"\nlegs = 1', "line 2: legs: must be a list, not 1."),
        ('name = "a"\nname = "b"', "line 2: is not TOML: cannot overwrite a value where the file ends."),
        ('name = "a"\nlegs = [', "line 2: is not TOML: invalid value where the file ends."),
    ],
)
def test_a_fault_is_one_sentence_with_line_key_value_and_what_is_allowed(text: str, said: str) -> None:
    with pytest.raises(FileFault) as problem:
        read(text, Table, "my.toml")
    assert str(problem.value) == f"my.toml, {said}"


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


def test_a_file_that_is_no_text_is_told_with_the_line(tmp_path: Path) -> None:
    (tmp_path / "latin.toml").write_bytes('name = "x"\n# Stra\u00dfe'.encode("latin-1"))
    with pytest.raises(WorldError, match=r"latin\.toml, line 2: is no UTF-8 text\."):
        load(tmp_path / "latin.toml")


def test_a_file_that_nobody_wrote_on_purpose_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "long.toml").write_bytes(b"#" * 1_000_001)
    with pytest.raises(FileFault, match="has more than 1,000,000 bytes"):
        text_of(tmp_path / "long.toml")


@pytest.mark.parametrize("mass", ["inf", "1e300"])
def test_a_figure_of_a_vehicle_has_an_end(tmp_path: Path, mass: str) -> None:
    own = Path(__file__).parents[3] / "sim/vehicles/patrol/patrol.toml"
    file = tmp_path / "patrol.toml"
    file.write_text(own.read_text(encoding="utf-8").replace("mass = 6.3", f"mass = {mass}"), encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"patrol\.toml, line 14: body\.mass: must be a number at most 1e\+06"
    ):
        load_parameters(file, PatrolParameters)


def test_figures_of_vehicles_and_payloads_name_the_line_too(tmp_path: Path) -> None:
    own = Path(__file__).parents[3] / "sim"
    for source, old, new, read_it, said in (
        (
            "vehicles/patrol/patrol.toml",
            "speed = ",
            "speed = -",
            lambda p: load_parameters(p, PatrolParameters),
            "limits",
        ),
        ("payloads/payloads.toml", "power = ", "power = -", load_payloads, "laser"),
    ):
        text = (own / source).read_text(encoding="utf-8")
        file = tmp_path / Path(source).name
        file.write_text(text.replace(old, new, 1))
        line = text[: text.index(old)].count("\n") + 1
        with pytest.raises(
            ValueError, match=rf"{file.name}, line {line}: {said}\.\w+: must be a number above 0, not -"
        ):
            read_it(file)
