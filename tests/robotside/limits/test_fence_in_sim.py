"""What floats and swims keeps to its fence by where it believes to be, driven against it and left alone at it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.core.config import Config, LimitSettings
from robotside.motion.manoeuvres import Order
from tests.robotside.hand import Hand, steer, tilt
from tests.robotside.test_driving_in_sim import box

pytestmark = pytest.mark.slow

Keep = Callable[[str, float, float, float], Hand]


@pytest.fixture
def hand(tmp_path: Path) -> Iterator[Keep]:
    hands = []

    def make(name: str, x: float, y: float, reach: float) -> Hand:
        fence = LimitSettings(keep_in=(box(x, y, reach),))
        hands.append(Hand(name, tmp_path, Config(limits=fence)))
        return hands[-1]

    yield make
    for each in hands:
        each.close()


def rooms(run: Hand, order: Order | None, seconds: float) -> tuple[float, float]:
    """The least room that it believes to have, and that it has [m], while it is driven or left alone."""
    keeper = run.station.keeper
    believed = true = math.inf
    for _ in range(round(seconds / 0.5)):
        run.wait(0.5) if order is None else run.push(order, 0.5)
        pose = run.station.autonomy.pose_estimator.pose
        assert pose is not None
        believed = min(believed, keeper.room(pose.x, pose.y) - run.robot.info.radius)
        true = min(true, keeper.room(*run.state.position[:2]) - run.robot.info.radius)
    return believed, true


def test_a_boat_that_idles_at_its_fence_is_carried_no_farther(hand: Keep) -> None:
    run = hand("minnow", -33.0, -24.0, 6.0)
    at_it, _ = rooms(run, steer(0.0, throttle=1.0), 10.0)
    left, true = rooms(run, None, 25.0)
    assert 1.3 < left < 2.0
    assert at_it > 1.3  # twice what a fix may be off
    assert true > 0.0
    assert "Minnow-1 drifts towards its fence; it goes back by itself." in run.events


def test_a_boat_told_to_turn_on_the_spot_does_not_creep_over_its_fence(hand: Keep) -> None:
    run = hand("minnow", -33.0, -24.0, 6.0)
    run.push(steer(0.0, throttle=1.0), 6.0)
    assert rooms(run, Twist.planar(0.0, 0.5), 10.0)[0] > 1.2


@pytest.mark.parametrize(
    "order", [tilt(roll=0.8, pitch=0.2, z=0.25, turn=0.3, throttle=1.0), tilt(roll=-0.8, z=0.25)]
)
def test_a_swimmer_that_rolls_and_turns_at_its_fence_is_not_carried_over_it(hand: Keep, order: Order) -> None:
    run = hand("aqua", -7.0, 0.0, 3.0)
    run.push(tilt(throttle=1.0), 4.0)
    believed, true = rooms(run, order, 12.0)
    assert believed > 0.3
    assert true > 0.0
