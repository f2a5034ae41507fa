"""Starts and goals: room round each, and a way from one to the other."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from sim.core.shapes import beside
from sim.training.free_places import FreePlaces
from sim.world.world_files import load

TWO_ROOMS = """
name = "two_rooms"
description = "A room with a shut one beside it."
[datum]
latitude = 0.0
longitude = 0.0
[ground]
length = 10.0
width = 6.0
[start]
x = -3.0
y = 0.0
[[blocks]]
x = 1.0
y = 0.0
length = 0.2
width = 6.0
height = 1.0
"""


def places(tmp_path: Path, gap: float) -> FreePlaces:
    """Two rooms with a wall between them that leaves a `gap` at its southern end [m]."""
    file = tmp_path / "two_rooms.toml"
    width = 6.0 - gap
    file.write_text(
        TWO_ROOMS.replace(
            "y = 0.0\nlength = 0.2\nwidth = 6.0", f"y = {gap / 2}\nlength = 0.2\nwidth = {width}"
        )
    )
    return FreePlaces(load(str(file)), 0.4, 0.3, 0.2, 0.4)


def drawn(free: FreePlaces) -> list[tuple[float, float]]:
    random = np.random.default_rng(0)
    return [free.draw(random) for _ in range(300)]


def test_no_place_is_in_a_room_that_no_way_leads_to(tmp_path: Path) -> None:
    assert max(x for x, _ in drawn(places(tmp_path, 0.0))) < 0.6
    assert max(x for x, _ in drawn(places(tmp_path, 0.4))) < 0.6  # narrower than the robot is


def test_a_gap_that_is_wide_enough_leads_there(tmp_path: Path) -> None:
    assert max(x for x, _ in drawn(places(tmp_path, 1.0))) > 3.0


def test_each_place_has_room_round_it_and_to_the_edge() -> None:
    world = load("office")
    free = FreePlaces(world, 0.4, 0.3, 0.2, 0.4)
    for x, y in drawn(free):
        assert free.has_room(x, y)
        assert abs(x) < world.ground.length / 2 - 0.4
        near = [solid for solid in world.solids if solid.position[2] - solid.size[2] / 2 < 0.4]
        assert min(beside(solid, x, y) for solid in near) > 0.3


def test_a_goal_is_as_far_as_is_said_or_there_is_none(tmp_path: Path) -> None:
    free, random = places(tmp_path, 0.0), np.random.default_rng(0)
    assert 2.0 <= math.dist(free.draw_apart(random, (-3.0, 0.0), 2.0, 3.0), (-3.0, 0.0)) <= 3.0
    with pytest.raises(ValueError, match=r"No place of two_rooms is 7 to 8 m from \(-3.0, 0.0\)\."):
        free.draw_apart(random, (-3.0, 0.0), 7.0, 8.0)


def test_a_robot_too_broad_for_the_start_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"A robot 7\.00 m wide has no room at the start of office\."):
        FreePlaces(load("office"), 4.0, 3.5, 0.2, 0.4)
