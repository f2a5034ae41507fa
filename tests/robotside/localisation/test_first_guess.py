"""Where a robot supposes to be that nobody has placed."""

from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import RobotInfo
from bridge.msgs.sensor_msgs import NavSatFix
from robotside.core.notice import Notice
from robotside.core.pose2 import Pose2
from robotside.localisation.beacons import FIXES_AVERAGED, Beacons
from robotside.localisation.first_guess import FIX_TIMEOUT, FirstGuess

ODOM = Pose2(3.0, 4.0, 0.5)


class Start:
    """A robot that is switched on at 50° north, 8° east."""

    def __init__(self, *, satellites: bool) -> None:
        self.said: list[str] = []
        beacons = Beacons(RobotInfo(latitude=50.0, longitude=8.0))
        self.guess = FirstGuess(beacons, self._say)
        if satellites:
            beacons.on_compass(1.0, 0.0)
            for _ in range(FIXES_AVERAGED):
                beacons.on_fix(NavSatFix(latitude=50.0 + 10.0 / 111_229.0, longitude=8.0))

    def _say(
        self, kind: str, text: Notice | str, level: str = "info", *, at: tuple[float, float] | None = None
    ) -> None:
        assert isinstance(text, Notice)
        self.said.append(text.code)


def test_with_satellites_and_compass_the_sweep_searches_round_their_place_at_once() -> None:
    start = Start(satellites=True)
    found = start.guess.to_search(0.0)
    assert found is not None
    pose, reach, turn = found
    assert (pose.x, pose.y) == pytest.approx((0.0, 10.0), abs=0.1)
    assert pose.yaw == 1.0
    assert reach < 5.0
    assert turn < 0.5
    assert not start.said


def test_without_them_it_waits_and_then_searches_round_the_origin_in_every_direction_and_says_so() -> None:
    start = Start(satellites=False)
    assert start.guess.to_search(7.0) is None
    assert start.guess.to_search(7.0 + FIX_TIMEOUT) is None
    assert not start.said
    found = start.guess.to_search(7.1 + FIX_TIMEOUT)
    assert found is not None
    assert found[0] == Pose2(0.0, 0.0, 0.0)
    assert found[2] == math.pi
    assert start.said == ["position_lost"]


def test_without_a_laser_it_waits_for_one_and_goes_by_satellites_then() -> None:
    start = Start(satellites=True)
    assert start.guess.to_reckon(ODOM, 7.0, waits=False) is None
    assert start.guess.to_reckon(ODOM, 7.0 + FIX_TIMEOUT, waits=True) is None
    guess = start.guess.to_reckon(ODOM, 7.0 + FIX_TIMEOUT, waits=False)
    assert guess is not None
    assert guess[0].y == pytest.approx(10.0, abs=0.1)
    assert guess[3]
    assert start.said == ["position_by_wheels"]


def test_with_neither_it_is_where_its_odometry_has_it() -> None:
    start = Start(satellites=False)
    start.guess.to_reckon(ODOM, 7.0, waits=False)
    guess = start.guess.to_reckon(ODOM, 7.0 + FIX_TIMEOUT, waits=False)
    assert guess is not None
    assert guess[0] == ODOM
    assert not guess[3]
