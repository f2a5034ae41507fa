"""Places judged by the robot's map: what the handheld says is what the robot would say."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from app.missions.ground import CLEARANCE, MARGIN, MAX_WAY_CELLS, Ground
from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import Point, Pose, Quaternion
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.planner import Planner, Unreachable
from tests.looped import looped
from widgets.core.quantities import quantities

RADIUS = 0.25


def chart(
    cells: np.ndarray, resolution: float = 0.1, corner: tuple[float, float] = (-2.0, -1.0)
) -> OccupancyGrid:
    rows, columns = cells.shape
    info = MapMetaData(
        resolution=resolution, width=columns, height=rows, origin=Pose(Point(corner[0], corner[1]))
    )
    return OccupancyGrid(info=info, data=Int8Array(cells.astype(np.int8).tobytes()))


def room(gap: int = 0) -> np.ndarray:
    """Two rooms of 6 m by 4 m, between them a wall with a gap of so many cells of 0.1 m."""
    cells = np.zeros((40, 120), np.int8)
    cells[0], cells[-1], cells[:, 0], cells[:, -1] = 100, 100, 100, 100
    cells[:, 60] = 100
    cells[10 : 10 + gap, 60] = 0
    return cells


def said(ground: Ground | None, x: float, y: float, robot: tuple[float, float] | None = None) -> str:
    assert ground is not None
    fault = ground.fault("Lab", x, y, robot)
    # the glass tears no figure from its unit, and has a true minus
    return fault.sentence.replace("\u00a0", " ").replace("−", "-") if fault is not None else ""


@pytest.mark.parametrize("clearance", [0.05, 0.3])
@pytest.mark.parametrize("resolution", [0.05, 0.1, 0.25], ids=lambda one: f"cells of {one} m")
def test_it_says_what_the_robot_says(resolution: float, clearance: float) -> None:
    chance = random.Random(7)
    cells = (np.random.default_rng(7).random((60, 80)) < 0.03) * np.int8(100)
    msg = chart(cells, resolution)
    ground, planner = Ground.of(msg, RADIUS, clearance), Planner(Grid.from_msg(msg), RADIUS, clearance)
    wide, high = 80 * resolution, 60 * resolution
    kinds = set()
    for _ in range(300):
        x, y = -2.0 + chance.uniform(-0.1, 1.1) * wide, -1.0 + chance.uniform(-0.1, 1.1) * high
        wanted = str(planner.fault("Lab", x, y)).replace("-0.0,", "0.0,").replace("-0.0)", "0.0)")
        assert said(ground, x, y) == wanted
        kinds.add(wanted.rsplit(") ", maxsplit=1)[-1][:8])
    assert len(kinds) >= 4


@pytest.mark.parametrize(("gap", "passes"), [(0, False), (2, False), (5, True), (8, True), (20, True)])
def test_a_place_that_no_way_leads_to_is_said_as_by_the_robot(gap: int, passes: bool) -> None:
    msg = chart(room(gap), corner=(0.0, 0.0))
    ground, planner = Ground.of(msg, RADIUS), Planner(Grid.from_msg(msg), RADIUS)
    if passes:
        assert len(planner.plan((1.0, 1.0), (9.0, 2.0), "Lab"))
        assert said(ground, 9.0, 2.0, (1.0, 1.0)) == ""
        return
    with pytest.raises(Unreachable) as refused:
        planner.plan((1.0, 1.0), (9.0, 2.0), "Lab")
    told = said(ground, 9.0, 2.0, (1.0, 1.0))
    assert told == "There is no way to Lab at (9.0, 2.0)."
    assert str(refused.value).startswith(told[:-1])  # which gap is too narrow the robot alone measures
    assert said(ground, 2.0, 2.0, (1.0, 1.0)) == ""
    assert said(ground, 9.0, 2.0) == ""  # where the robot is is not known


def test_a_robot_that_stands_close_to_a_wall_has_ways_all_the_same() -> None:
    ground = Ground.of(chart(room(), corner=(0.0, 0.0)), RADIUS)
    assert said(ground, 2.0, 2.0, (0.2, 0.2)) == ""
    assert said(ground, 9.0, 2.0, (0.2, 0.2)).startswith("There is no way")


def test_what_the_map_does_not_know_is_no_place_to_stand() -> None:
    cells = room()
    cells[20:, :30] = -1
    ground = Ground.of(chart(cells, corner=(0.0, 0.0)), RADIUS)
    assert said(ground, 1.0, 3.0) == "Lab at (1.0, 3.0) is where the map knows nothing."
    assert said(ground, 1.0, 1.0) == ""


@pytest.mark.parametrize(
    "grid",
    [
        None,
        OccupancyGrid(),
        OccupancyGrid(info=MapMetaData(resolution=0.1, width=3, height=3), data=Int8Array(b"\0")),
        OccupancyGrid(
            info=MapMetaData(
                resolution=0.1, width=1, height=1, origin=Pose(Point(), Quaternion.from_yaw(0.3))
            ),
            data=Int8Array(b"\0"),
        ),
    ],
    ids=["none", "empty", "too short", "turned"],
)
def test_without_a_map_to_judge_by_nothing_is_judged(grid: OccupancyGrid | None) -> None:
    assert Ground.of(grid, RADIUS) is None


def test_a_place_that_is_no_number_is_off_the_map() -> None:
    ground = Ground.of(chart(room()), RADIUS)
    assert "off the map" in said(ground, math.nan, 1.0)


def test_on_a_map_too_large_to_look_for_ways_walls_are_said_and_ways_are_not() -> None:
    cells = np.zeros((900, 900), np.int8)
    assert cells.size > MAX_WAY_CELLS
    cells[:, 450] = 100
    ground = Ground.of(chart(cells, corner=(0.0, 0.0)), RADIUS)
    assert "in a wall" in said(ground, 45.0, 5.0, (1.0, 1.0))
    assert said(ground, 80.0, 5.0, (1.0, 1.0)) == ""


def test_the_room_that_is_needed_is_that_of_the_robot_and_a_margin() -> None:
    ground = Ground.of(chart(room(), corner=(0.0, 0.0)), RADIUS)
    fault = ground.fault("Lab", 0.25, 2.0, None) if ground is not None else None
    assert fault is not None
    assert f"needs {RADIUS + CLEARANCE + MARGIN:.2f}\u00a0m" in fault.sentence
    assert fault.brief == "0.15\u00a0m free"


@looped(
    ("resolution", "x"),
    [(math.nan, 0.0), (0.05, math.nan), (0.05, math.inf), (1e-320, 0.0), (0.0, 0.0), (math.inf, 0.0)],
)
def test_by_a_map_whose_measures_are_nonsense_nothing_is_judged(resolution, x):
    info = MapMetaData(resolution=resolution, width=2, height=2, origin=Pose(position=Point(x, 0.0)))
    assert Ground.of(OccupancyGrid(info=info, data=Int8Array(bytes(4))), 0.2) is None


def test_it_says_how_much_room_there_is_in_the_units_of_the_operator(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(quantities, "system", "imperial")
    ground = Ground.of(chart(room(), corner=(0.0, 0.0)), RADIUS)
    fault = ground.fault("Lab", 0.25, 2.0, None) if ground is not None else None
    assert fault is not None
    assert fault.brief == "0.5\u00a0ft free"
