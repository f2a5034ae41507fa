"""The small sensors: what is painted under the robot, and what stands close to it."""

from __future__ import annotations

import math
import statistics
from typing import Any

import numpy as np
import pytest

from sim.world.paint import Paint
from sim.world.world import World
from sim.world.world_files import load, parse
from tests.sim.rooms import ROOM, robot_in, room


def painted(marks: str, **place: float) -> World:
    """A room of 40 m with `marks` on its ground."""
    spot = {"length": 40.0, "width": 40.0, "x": 0.0, "y": 0.0, "yaw": 0.0, **place}
    return parse(ROOM.format(**spot) + marks, "room.toml")


ALONG = "[[lines]]\nfrom = [-5.0, {0}]\nto = [5.0, {0}]\nwidth = 0.06\n"


def first(world: World, topic: str, **more: Any) -> Any:
    """The first message on `topic` of a robot at rest in `world`."""
    robot = robot_in(world, **more)
    messages = robot.read(0.11)
    robot.close()
    return next(message for name, message in messages if name == topic)


def share(world: World, x: float, y: float) -> float:
    return float(Paint(world).share(np.array([[x, y]]), 0.005)[0])


def test_a_line_ahead_is_bright_under_the_middle_cells_and_asphalt_is_dark() -> None:
    told = first(painted(ALONG.format(0.0)), "/line_sensor")
    assert list(told.values[3:5]) == pytest.approx([0.8, 0.8])
    assert [told.values[0], told.values[7]] == pytest.approx([0.12, 0.12])
    assert (told.header.frame_id, told.spacing) == ("line_sensor", 0.020)


def test_the_cells_are_told_from_left_to_right() -> None:
    left = first(painted(ALONG.format(0.06)), "/line_sensor").values
    right = first(painted(ALONG.format(-0.06)), "/line_sensor").values
    assert left[1] > 0.7 > 0.2 > left[6]
    assert right[6] > 0.7 > 0.2 > right[1]


def test_the_cells_turn_with_the_robot() -> None:
    told = first(painted(ALONG.format(0.06), yaw=180), "/line_sensor").values
    assert told[6] > 0.7 > 0.2 > told[1]


def test_bare_ground_is_dark_everywhere() -> None:
    assert list(first(room(), "/line_sensor").values) == pytest.approx([0.12] * 8)


def test_the_noise_of_the_cells_is_as_large_as_their_parameters_say() -> None:
    robot = robot_in(room(), noise=True, seed=2)
    values = np.array([m.values for name, m in robot.read(5.0) if name == "/line_sensor"])
    robot.close()
    assert len(values) == 100
    assert float(values.std(axis=0).mean()) == pytest.approx(0.015, rel=0.2)


def test_of_a_line_that_reaches_half_into_a_spot_half_is_seen() -> None:
    assert share(painted(ALONG.format(0.0)), 0.0, 0.03) == pytest.approx(0.5)
    assert share(painted(ALONG.format(0.0)), 5.0, 0.0) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("x", "y", "paint"),
    [
        (-15.0, 12.0, 1.0),
        (-12.5, 12.0, 1.0),
        (-13.7, 12.0, 0.0),
        (-12.5, 7.5, 0.0),
        (3.0, 0.0, 1.0),
        (9.0, 7.5, 1.0),
        (9.0, 8.3, 0.0),
    ],
)
def test_the_car_park_is_painted_where_its_pictures_are(x: float, y: float, paint: float) -> None:
    assert share(load("parking_lot"), x, y) == pytest.approx(paint)


def echoes(world: World, **more: Any) -> dict[str, float]:
    robot = robot_in(world, **more)
    told = {name: message.range for name, message in robot.read(0.11) if name.startswith("/range/")}
    robot.close()
    return {name.rpartition("/")[2]: measured for name, measured in told.items()}


def test_each_side_hears_its_own_wall() -> None:
    """A room of 6 by 4 m, the robot off its middle; the rangers sit 0.17 m from the axis."""
    found = echoes(room(6.0, 4.0, x=1.0, y=0.5))
    expected = {"front": 2.0, "left": 1.5, "right": 2.5, "rear": 4.0}
    assert found == pytest.approx({side: away - 0.17 for side, away in expected.items()}, abs=2e-3)


def test_out_of_reach_is_infinitely_far_and_too_near_is_minus_infinity() -> None:
    assert echoes(room()) == dict.fromkeys(("front", "left", "right", "rear"), math.inf)
    assert echoes(room(x=19.815))["front"] == -math.inf


def test_what_stands_beside_the_axis_but_in_the_cone_is_heard() -> None:
    cone = "[[cones]]\nx = 2.0\ny = {}\nheight = 0.6\n"
    assert echoes(painted(cone.format(0.15)))["front"] == pytest.approx(1.7, abs=0.15)
    assert echoes(painted(cone.format(0.8)))["front"] == math.inf


def test_a_ranger_says_what_it_is() -> None:
    told = first(room(), "/range/left")
    assert (told.header.frame_id, told.radiation_type) == ("ultrasound_left", told.ULTRASOUND)
    assert (told.min_range, told.max_range) == (0.02, 4.0)
    assert told.field_of_view == pytest.approx(math.radians(15), abs=1e-3)


def test_the_noise_of_a_ranger_is_as_large_as_its_data_sheet_says() -> None:
    robot = robot_in(room(6.0, 4.0), noise=True, seed=5)
    told = [message.range for name, message in robot.read(8.0) if name == "/range/rear"]
    robot.close()
    assert len(told) == 80
    assert statistics.stdev(told) == pytest.approx(0.003, rel=0.3)
