"""Places that fit a sweep, found on the whole map without a guess."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.sensor_msgs import LaserScan
from robotside.core.pose2 import Pose2
from robotside.core.worker import completed
from robotside.localisation.explanation import Look
from robotside.localisation.field import Field
from robotside.localisation.place_search import MAX_FOUND, Found, differ, search
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from tests.fakes import Box, FakeRobot
from tests.robotside.localisation.ride import FLOOR, equal_rooms

BOXES = (Box(-4.0, 2.0, -2.0, 4.0), Box(3.0, -4.0, 4.0, -2.0), Box(5.0, 3.0, 7.0, 3.5))


def places(robot: FakeRobot) -> list[Found]:
    for _, msg in robot.read(0.0):
        if isinstance(msg, LaserScan):
            look = Look.of(LaserProjection().points(msg))
    return completed(search(Field(Grid.from_msg(robot.map())), look))


@pytest.mark.parametrize("start", [(1.0, -1.0, 0.7), (-7.3, 3.1, -2.5), (8.5, -4.6, 3.1), (4.6, 1.0, 1.6)])
def test_wherever_it_is_that_place_is_the_first_one_found(start: tuple[float, float, float]) -> None:
    found = places(FakeRobot(start=start, boxes=BOXES))
    best = found[0].pose
    assert best.distance(*start[:2]) < 0.08
    assert abs(math.remainder(best.yaw - start[2], math.tau)) < 0.03
    assert found[0].explanation.evidence - found[1].explanation.evidence > 1.0


def test_of_a_sweep_in_one_of_equal_rooms_all_of_them_are_found_and_none_is_better() -> None:
    robot = FakeRobot(start=(-2.0, 3.2, 1.0), hall=FLOOR, boxes=equal_rooms(), beams=120)
    found = places(robot)
    inner = [(-2.0, 3.2, 1.0), (2.0, 3.2, 1.0), (2.0, -3.2, 1.0 - math.pi), (-2.0, -3.2, 1.0 - math.pi)]
    for x, y, yaw in inner:
        near = [each for each in found if not differ(each.pose, Pose2(x, y, yaw))]
        assert len(near) == 1
        assert near[0].explanation.evidence > found[0].explanation.evidence - 1.0
    assert len(found) <= MAX_FOUND


def test_places_are_told_apart_and_none_lies_in_a_wall() -> None:
    robot = FakeRobot(start=(-2.0, 0.0, 0.0), hall=FLOOR, boxes=equal_rooms(), beams=120)
    found = places(robot)
    assert all(differ(a.pose, b.pose) for a in found for b in found if a is not b)
    field = Field(Grid.from_msg(robot.map()))
    assert not field.full(np.array([each.pose[:2] for each in found])).any()


def test_of_too_few_beams_nothing_is_found() -> None:
    field = Field(Grid.from_msg(FakeRobot().map()))
    assert completed(search(field, Look.of(np.array([[1.0, 0.0], [2.0, 1.0]])))) == []
