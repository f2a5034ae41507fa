"""The heights that orders and points may name."""

from __future__ import annotations

import math

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.refusal import Refusal
from robotside.tasks.order_heights import OrderHeights, given_height

DRONE = RobotInfo(name="D", kind="quadrotor", world="yard")
AQUA = RobotInfo(name="A", kind="hexapod")
WHEELS = RobotInfo(name="W", kind="wheels")


def refused(heights: OrderHeights, height: float, point: str = "") -> Refusal:
    with pytest.raises(Refusal) as found:
        heights.check_point(height, point) if point else heights.check(height)
    return found.value


def test_a_height_beyond_reach_is_refused_with_what_is_allowed_and_the_point() -> None:
    drone, aqua = OrderHeights(DRONE, (0.05, 12.34)), OrderHeights(AQUA, (-4.87, 0.0))
    said = refused(drone, 50.0, "Point 3")
    assert str(said) == "The height of D in yard at point 3 must be from 0.3 to 12.3 m, not 50 m."
    assert said.notice.code == Code.HEIGHT_INVALID
    for height in (0.1, -1.0, 12.35, math.inf):
        refused(drone, height)
    for height in (0.1, -4.9, -math.inf):
        refused(aqua, height, "Home")
    for fits in (0.3, 5.0, 12.3):
        drone.check_point(fits, "Point 1")
    for fits in (-0.1, -4.8):
        aqua.check_point(fits, "Point 1")


def test_a_point_without_a_height_is_that_of_any_robot_and_one_with_a_height_not_of_one_on_wheels() -> None:
    wheels = OrderHeights(WHEELS, (-math.inf, math.inf))
    for none in (math.nan, 0.0):
        for heights in (wheels, OrderHeights(DRONE, (0.05, 10.0)), OrderHeights(AQUA, (-5.0, 0.0))):
            heights.check_point(none, "Point 1")
    assert str(refused(wheels, 1.0, "Point 2")) == "W keeps no height; leave it out at point 2."


def test_the_height_of_a_pose_from_elsewhere_counts_for_what_swims_or_flies_unless_it_is_that_of_a_flat_map() -> (
    None
):
    assert given_height(2.5, DRONE) == 2.5
    assert given_height(-1.5, AQUA) == -1.5
    for z, info in ((0.0, DRONE), (math.nan, AQUA), (math.inf, DRONE), (2.5, WHEELS)):
        assert math.isnan(given_height(z, info))
