"""What the guide tells of heights to however the robot goes, without knowing which that is."""

from __future__ import annotations

import math

import msgspec
import pytest

from robotside.kinds.registry import KINDS
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.navigator import Navigator
from robotside.navigation.path_controller import GroundBound, PathController
from tests.fakes import FakeRobot


class Hopping(GroundBound):
    """Some other way to go that has heights."""

    def __init__(self) -> None:
        super().__init__()
        self.rose: list[float] = []

    def take_off(self, height: float = math.nan) -> None:
        """Rise."""
        self.rose.append(height)


def guide(kind: str = "wheels") -> Navigator:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, kind=kind)
    return Navigator(robot, Grid.from_msg(robot.map()), lambda _: None)


def test_heights_and_taking_off_reach_any_way_of_going() -> None:
    guide_, going = guide(), Hopping()
    guide_.going = going  # type: ignore[assignment]
    guide_.measured(0.4)
    guide_.keep_height(1.5)
    guide_.flies("taking_off")
    guide_.take_off(2.5)
    assert (guide_.height, going.height, going.aloft, going.rose) == (0.4, 1.5, False, [2.5])


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_hears_of_its_height(kind: str) -> None:
    guide_ = guide(kind)
    going: PathController = guide_.going
    assert math.isnan(guide_.height)
    guide_.measured(-2.0)
    guide_.keep_height(-3.0)
    assert (guide_.height, going.height) == (-2.0, -3.0)
    guide_.take_off(1.0)
    assert going.ready() == ""
