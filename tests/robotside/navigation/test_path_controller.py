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


def navigator(kind: str = "wheels") -> Navigator:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, kind=kind)
    return Navigator(robot, Grid.from_msg(robot.map()), lambda _: None)


def test_heights_and_taking_off_reach_any_way_of_going() -> None:
    navigator_, controller = navigator(), Hopping()
    navigator_.controller = controller  # type: ignore[assignment]
    navigator_.measured(0.4)
    navigator_.keep_height(1.5)
    navigator_.flies("taking_off")
    navigator_.take_off(2.5)
    assert (navigator_.height, controller.height, controller.aloft, controller.rose) == (
        0.4,
        1.5,
        False,
        [2.5],
    )


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_hears_of_its_height(kind: str) -> None:
    navigator_ = navigator(kind)
    controller: PathController = navigator_.controller
    assert math.isnan(navigator_.height)
    navigator_.measured(-2.0)
    navigator_.keep_height(-3.0)
    assert (navigator_.height, controller.height) == (-2.0, -3.0)
    navigator_.take_off(1.0)
    assert controller.ready() == ""
