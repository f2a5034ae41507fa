"""Docks at which no robot could ever stand are refused, by name and place."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.world.world_files import WorldError, load

LAND = """
name = "yard"
description = "A yard"
ground = {length = 12.0, width = 12.0}
start = {x = -5.0, y = -5.0}
datum = {latitude = 45.0, longitude = 9.0}
wall = {height = 1.0, thickness = 0.2}
"""
WATER = LAND + "water = {depth = 4.0}\n"


def dock(
    kind: str, x: float, y: float, *, name: str = "A", tag: int = 0, yaw: float = 0.0, z: float = 0.0
) -> str:
    return (
        f'[[docks]]\nname = "{name}"\nkind = "{kind}"\nx = {x}\ny = {y}\nyaw = {yaw}\nz = {z}\ntag = {tag}\n'
    )


def said(folder: Path, text: str) -> str:
    """What is wrong with the world; empty when nothing is."""
    (folder / "yard.toml").write_text(text)
    try:
        load(str(folder / "yard.toml"))
    except WorldError as fault:
        return str(fault).partition(": ")[2]
    return ""


@pytest.mark.parametrize(
    ("world", "kind", "z"),
    [
        (LAND, "contacts", 0.0),
        (LAND, "pad", 0.0),
        (WATER, "jetty", 0.0),
        (WATER, "cage", -1.5),
        (WATER, "pad", 0.3),
    ],
)
def test_a_dock_that_has_room_is_taken_and_one_in_a_block_is_not(
    tmp_path: Path, world: str, kind: str, z: float
) -> None:
    block = "[[blocks]]\nx = 2.0\ny = 1.0\nz = -3.0\nlength = 1.0\nwidth = 1.0\nheight = 5.0\n"
    assert said(tmp_path, world + block + dock(kind, -2.0, 1.0, z=z)) == ""
    assert said(tmp_path, world + block + dock(kind, 2.0, 1.0, z=z)) == (
        "docks[0]: the dock 'A' at (2, 1) is inside the block at (2, 1), where its robot would stand."
    )


def test_its_back_may_be_in_the_wall_and_its_front_not(tmp_path: Path) -> None:
    assert said(tmp_path, LAND + dock("contacts", 5.9, 0.0)) == ""
    turned = said(tmp_path, LAND + dock("contacts", 5.9, 0.0, yaw=180.0))
    assert turned.startswith("docks[0]: the dock 'A' at (5.9, 0) is inside the wall at (6")


def test_a_thin_partition_through_the_berth_is_seen_and_what_hangs_above_is_not(tmp_path: Path) -> None:
    thin = "[[partitions]]\nfrom = [0.0, 0.01]\nto = [0.3, 3.0]\nwidth = 0.02\n"
    assert "is inside the block" in said(tmp_path, LAND + thin + dock("contacts", 0.2, 0.2))
    shelf = "[[blocks]]\nx = 0.0\ny = 0.0\nz = 0.4\nlength = 1.0\nwidth = 1.0\nheight = 1.0\n"
    assert said(tmp_path, LAND + shelf + dock("contacts", 0.2, 0.2)) == ""


@pytest.mark.parametrize(
    ("one", "other", "fits"),
    [
        (("contacts", 0.0, 0.0), ("contacts", 0.0, 0.0), False),
        (("contacts", 0.0, 0.0), ("contacts", 0.0, 0.4), False),
        (("contacts", 0.0, 0.0), ("contacts", 0.0, 0.5), True),
        (("contacts", 0.0, 0.0), ("pad", -0.5, 0.0), False),
        (("pad", 0.0, 0.0), ("contacts", -0.5, 0.0), False),
        (("contacts", 0.0, 0.0), ("pad", 1.0, 0.0), True),
    ],
)
def test_two_docks_on_one_spot_are_refused_with_names_and_places(
    tmp_path: Path, one: tuple[str, float, float], other: tuple[str, float, float], fits: bool
) -> None:
    found = said(tmp_path, LAND + dock(*one) + dock(*other, name="B", tag=1))
    _, x, y = other
    wanted = f"docks[1]: the dock 'B' at ({x:g}, {y:g}) is on the spot of the dock 'A' at (0, 0): no robot could stand at either."
    assert found == ("" if fits else wanted)
