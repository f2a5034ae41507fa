"""The measures of the bench of localisation."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import numpy as np
import pytest

from bench.localisation import (
    FIGURES,
    consistency,
    equal_rooms,
    grid_of,
    hidden,
    nees,
    places,
    wander,
    without_cars,
)
from robotside.core.pose2 import Pose2
from robotside.mapping.occupancy_grid import Grid

ROUND = np.array(
    [[3.0 * math.cos(a), 3.0 * math.sin(a)] for a in np.linspace(-math.pi, math.pi, 360, endpoint=False)]
)


def test_the_squares_of_errors_drawn_from_a_covariance_are_three_on_average() -> None:
    covariance = np.array([[4e-4, 1e-4, 0.0], [1e-4, 9e-4, 1e-5], [0.0, 1e-5, 1e-5]])
    drawn = np.random.default_rng(1).multivariate_normal(np.zeros(3), covariance, 4000).tolist()
    truth = Pose2(1.0, 2.0, math.pi)
    found = [nees(Pose2(1.0 + x, 2.0 + y, math.pi + yaw), covariance, truth) for x, y, yaw in drawn]
    assert np.mean(found) == pytest.approx(3.0, abs=0.15)


def test_a_crowd_hides_two_of_three_directions_and_lets_none_see_farther() -> None:
    reach = np.hypot(*hidden(ROUND).T)
    assert (reach < 1.01).mean() == pytest.approx(2 / 3, abs=0.05)
    assert set(np.round(reach, 6)) == {1.0, 3.0}


def test_it_drives_where_there_is_room_and_turns_where_there_is_none() -> None:
    assert wander(ROUND).linear.x > 0.0
    assert wander(ROUND / 4.0).linear.x == 0.0


def test_places_have_room_and_every_second_car_is_gone(tmp_path: Path) -> None:
    grid = Grid(np.pad(np.zeros((40, 60), dtype=np.bool_), 5, constant_values=True), 0.1, 0.0, 0.0)
    assert (grid.clearance(np.array([each[:2] for each in places(grid, 30, 1)])) > 0.5).all()
    emptied = tomllib.loads(Path(without_cars(tmp_path)).read_text())
    assert 5 < len(emptied["cars"]) < 20


def test_a_floor_of_equal_rooms_looks_the_same_after_half_a_turn_and_its_rooms_from_within(
    tmp_path: Path,
) -> None:
    grid = grid_of(equal_rooms(tmp_path))
    occupied = grid.occupied
    assert (occupied == occupied[::-1, ::-1]).all()
    row, column = grid.cell(-7.5, 1.2)
    one, next_one = (occupied[row : row + 35, column + 40 * n : column + 40 * n + 35] for n in (0, 1))
    assert 20 < (one == next_one).sum() == one.size
    doors = [grid.clearance(np.array([[x, 1.2]]))[0] > 0.4 for x in (-6.0, -2.0, 2.0, 6.0)]
    assert doors == [True] * 4


def test_no_wrong_place_may_be_believed() -> None:
    assert {each.target for each in FIGURES if each.name.endswith("_wrong")} == {0.0}


def test_the_told_uncertainty_has_its_band_for_lasers_and_a_limit_for_sonars() -> None:
    targets = {each.name: each.target for each in FIGURES if "nees" in each.name}
    assert targets == {
        "nees_standing": 3.5,
        "nees_standing_off": 0.5,
        "nees_driving": 3.5,
        "nees_driving_off": 0.5,
        "sonar_nees_standing": 3.5,
        "sonar_nees_driving": 3.5,
    }


@pytest.mark.slow
def test_what_robots_tell_of_their_place_is_true_by_laser_and_by_sonars() -> None:
    laser, _ = consistency("patrol", ("office", "parking_lot"), 12)
    sonars, _ = consistency("scout", ("office",), 8)
    assert laser["nees_driving"] < 4.6
    assert laser["error_driving"] < 60.0
    assert sonars["nees_driving"] < 5.0
    assert sonars["nees_standing"] < 6.0
