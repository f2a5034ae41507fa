"""The grip of the ground: each figure names its source, and a world says which one it has."""

from __future__ import annotations

import re
from pathlib import Path
from typing import get_args

import pytest

from sim.world import surfaces
from sim.world.surfaces import GRIP, LOOKS_LIKE, Surface
from sim.world.tables import Ground
from sim.world.world_files import WORLDS, WorldError, load, parse


def test_each_surface_has_a_grip_with_its_source():
    assert set(GRIP) == set(get_args(Surface))
    text = Path(surfaces.__file__).read_text(encoding="utf-8")
    for name in GRIP:
        assert re.search(rf'"{name}": 0\.\d+,  # \[[A-Z]\]', text), name


def test_what_is_wet_holds_less():
    for dry in ("asphalt", "grass", "floor"):
        assert GRIP[f"wet_{dry}"] < GRIP[dry]


def test_a_ground_is_what_it_looks_like_unless_the_file_says_more():
    assert Ground(10.0, 10.0).grip == GRIP["asphalt"]
    assert {look: Ground(10.0, 10.0, look).grip for look in LOOKS_LIKE} == {
        look: GRIP[surface] for look, surface in LOOKS_LIKE.items()
    }
    assert Ground(10.0, 10.0, "grass", "wet_grass").grip == GRIP["wet_grass"]


def test_the_worlds_have_asphalt_floor_and_grass():
    grips = {name: load(name).ground.grip for name in WORLDS if load(name).water is None}
    assert grips == {"parking_lot": GRIP["asphalt"], "office": GRIP["floor"], "orchard": GRIP["grass"]}


def test_a_world_with_an_unknown_surface_is_refused_with_what_is_allowed():
    text = (
        'name = "x"\ndescription = ""\n[datum]\nlatitude = 1.0\nlongitude = 1.0\n'
        '[ground]\nlength = 9.0\nwidth = 9.0\nsurface = "ice"\n[start]\nx = 0.0\ny = 0.0\n'
    )
    with pytest.raises(WorldError, match="surface.*ice"):
        parse(text, "x.toml")
