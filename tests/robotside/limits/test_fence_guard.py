"""The fence holds whatever is commanded: the first command, the next hundred, and a loss of the link at any moment."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robotside.core.config import Ring
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import KINDS
from robotside.kinds.vehicle_kind import Handling
from robotside.limits.fence import Fence
from robotside.limits.fence_guard import GAP, FenceGuard
from robotside.motion.stopping_path import REST, PlanarVelocity

RADIUS = 0.2
WHEELS = KINDS["wheels"].handling


def box(west: float, south: float, east: float, north: float) -> Ring:
    return ((west, south), (east, south), (east, north), (west, north))


YARD = Fence([box(-4.0, -3.0, 4.0, 3.0), box(3.5, -1.0, 8.0, 1.0)], [box(-1.0, 1.0, 1.0, 2.0)])
TICK = 0.05


class Vehicle:
    """A disc whose speed and turn rate follow commands as its kind can, or at once."""

    def __init__(self, pose: Pose2, handling: Handling, *, prompt: bool, swings: bool = False) -> None:
        self.pose, self.moving = pose, REST
        self._handling, self._prompt, self._swings = handling, prompt, swings
        self.least = math.inf

    def go(self, command: PlanarVelocity) -> None:
        for _ in range(5):
            self._follow(command, TICK / 5)
            yaw = self.pose.yaw + self.moving.turn * TICK / 10
            c, s = math.cos(yaw), math.sin(yaw)
            vx, vy = c * self.moving.x - s * self.moving.y, s * self.moving.x + c * self.moving.y
            x, y = self.pose.x + vx * TICK / 5, self.pose.y + vy * TICK / 5
            self.pose = Pose2(x, y, yaw + self.moving.turn * TICK / 10)
            self.least = min(self.least, float(YARD.clearance(np.array([[x, y]]))[0]) - RADIUS)

    def _follow(self, command: PlanarVelocity, time: float) -> None:
        if self._prompt:
            self.moving = command
            return
        ax, ay = command.x - self.moving.x, command.y - self.moving.y
        part = min(1.0, self._handling.braking * time / max(math.hypot(ax, ay), 1e-9))
        turn, most = command.turn, self._handling.turning * time
        if self._swings and not self._handling.steers:
            turn = max(self.moving.turn - most, min(self.moving.turn + most, turn))
        x, y = self.moving.x + part * ax, self.moving.y + part * ay
        if self._handling.steers:
            turn = self._bend(command) * math.hypot(x, y)
        self.moving = PlanarVelocity(x, y, turn)

    def _bend(self, command: PlanarVelocity) -> float:
        """Of one that steers [1/m]; told to stop it keeps its wheels as they are when it `swings`, else straight."""
        if command.speed > 1e-3:
            return command.turn / command.speed
        return self.moving.turn / max(self.moving.speed, 1e-3) if self._swings else 0.0

    def come_to_rest(self) -> None:
        for _ in range(400):
            if self.moving.speed < 1e-6:
                return
            self.go(REST)


def test_far_from_the_fence_a_command_is_obeyed_as_it_is() -> None:
    wanted = PlanarVelocity(0.7, 0.0, 0.5)
    assert FenceGuard(YARD, RADIUS, WHEELS).slowed(Pose2(-2.5, 0.0, 0.0), REST, wanted) == wanted


def test_towards_the_fence_it_gets_slower_and_stops_before_it() -> None:
    fencing = FenceGuard(YARD, RADIUS, WHEELS)
    robot = Vehicle(Pose2(-3.0, 0.0, math.pi), WHEELS, prompt=True)
    seen = []
    for _ in range(200):
        robot.go(fencing.slowed(robot.pose, robot.moving, PlanarVelocity(0.7, 0.0, 0.0)))
        seen.append(robot.moving.x)
    assert all(after <= before for before, after in pairwise(seen))
    assert seen[-1] < 0.02
    assert GAP - 0.02 < robot.least < GAP + 0.05


def test_along_away_and_on_the_spot_it_is_free() -> None:
    fencing = FenceGuard(YARD, RADIUS, WHEELS)
    close = Pose2(-4.0 + RADIUS + GAP, 0.0, math.pi)
    for wanted in (PlanarVelocity(-0.7, 0.0, 0.0), PlanarVelocity(0.0, 0.0, 1.9)):
        assert fencing.slowed(close, REST, wanted) == wanted
    along = PlanarVelocity(0.7, 0.0, 0.0)
    assert fencing.slowed(Pose2(close.x, 0.0, math.pi / 2), REST, along) == along


def test_a_turn_towards_the_fence_is_put_off_until_it_is_slow_enough() -> None:
    fencing = FenceGuard(YARD, RADIUS, WHEELS)
    close = Pose2(-4.0 + RADIUS + GAP + 0.02, -1.5, math.pi / 2)
    turn = PlanarVelocity(0.05, 0.0, 1.9)
    assert fencing.slowed(close, REST, turn) == turn
    assert fencing.slowed(close, PlanarVelocity(1.5, 0.0, 0.0), turn) == REST


def test_a_turn_that_has_not_died_away_yet_is_counted_in() -> None:
    fencing = FenceGuard(YARD, RADIUS, WHEELS)
    close = Pose2(-4.0 + RADIUS + GAP + 0.02, -1.5, math.pi / 2)
    straight = PlanarVelocity(0.7, 0.0, 0.0)
    assert fencing.slowed(close, straight, straight) == straight
    assert fencing.slowed(close, PlanarVelocity(0.7, 0.0, 1.5), straight) != straight


def test_one_that_can_go_sideways_slides_along_the_fence() -> None:
    fencing = FenceGuard(YARD, RADIUS, KINDS["quadrotor"].handling)
    slid = fencing.slowed(Pose2(-4.0 + RADIUS + GAP, 0.0, math.pi), REST, PlanarVelocity(0.5, 0.5, 0.0))
    assert slid.x == pytest.approx(0.0, abs=0.02)
    assert slid.y == pytest.approx(0.5)


def test_what_slides_along_a_fence_that_it_came_too_near_to_goes_inward_a_little() -> None:
    fencing = FenceGuard(YARD, RADIUS, KINDS["quadrotor"].handling)
    slid = fencing.slowed(Pose2(-4.0 + RADIUS - 0.05, 0.0, math.pi), REST, PlanarVelocity(0.5, 0.5, 0.0))
    assert slid.x == pytest.approx(-0.15, abs=0.03)
    assert slid.y == pytest.approx(0.5)


def test_one_that_steers_goes_slower_on_the_same_arc() -> None:
    fencing = FenceGuard(YARD, RADIUS, KINDS["ackermann"].handling)
    slowed = fencing.slowed(Pose2(-3.4, 0.0, math.pi), REST, PlanarVelocity(2.0, 0.0, 0.5))
    assert 0.0 < slowed.x < 2.0
    assert slowed.turn / slowed.x == pytest.approx(0.25)


def test_from_outside_only_ways_that_lead_back_are_allowed() -> None:
    fencing = FenceGuard(YARD, RADIUS, WHEELS)
    lost = Pose2(-6.0, 0.0, 0.0)
    assert fencing.slowed(lost, REST, PlanarVelocity(0.7, 0.0, 0.0)) == PlanarVelocity(0.7, 0.0, 0.0)
    assert fencing.slowed(lost, REST, PlanarVelocity(-0.7, 0.0, 0.3)) == PlanarVelocity(0.0, 0.0, 0.3)


def test_a_way_through_a_thin_area_is_no_way_past_it() -> None:
    wall = Fence([box(-9.0, -9.0, 9.0, 9.0)], [box(1.0, -9.0, 1.01, 9.0)])
    slowed = FenceGuard(wall, 0.0, KINDS["ackermann"].handling).slowed(
        Pose2(0.0, 0.0, 0.0), REST, PlanarVelocity(5.0, 0.0, 0.0)
    )
    assert slowed.x < 1.8


PLACES = st.tuples(st.floats(-3.6, 3.6), st.floats(-2.6, 2.6), st.floats(-math.pi, math.pi)).filter(
    lambda place: float(YARD.clearance(np.array([place[:2]]))[0]) > RADIUS + GAP
)
COMMANDS = st.lists(
    st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-1.9, 1.9), st.integers(1, 30)),
    min_size=1,
    max_size=8,
)
FASTEST = {"wheels": 0.7, "ackermann": 2.0, "boat": 0.8, "hexapod": 0.5, "quadrotor": 2.0}


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(PLACES, COMMANDS, st.sampled_from(sorted(KINDS)), st.booleans(), st.booleans())
def test_whatever_is_commanded_from_inside_the_body_stays_inside_until_it_is_at_rest(
    place: tuple[float, float, float],
    commands: list[tuple[float, float, float, int]],
    kind: str,
    prompt: bool,
    swings: bool,
) -> None:
    handling, fastest = KINDS[kind].handling, FASTEST[kind]
    fencing = FenceGuard(YARD, RADIUS, handling)
    robot = Vehicle(Pose2(*place), handling, prompt=prompt, swings=swings)
    for forward, left, turn, ticks in commands:
        y = left * fastest if handling.sideways else 0.0
        rate = turn * abs(forward) / 2 if handling.steers else turn
        wanted = PlanarVelocity(forward * fastest, y, rate)
        for _ in range(ticks):
            robot.go(fencing.slowed(robot.pose, robot.moving, wanted))
    robot.come_to_rest()
    assert robot.least > 0.0


def test_the_less_sure_its_place_is_the_farther_it_keeps_from_the_fence() -> None:
    guard, south = FenceGuard(YARD, RADIUS, WHEELS), Pose2(0.0, -2.0, -math.pi / 2)
    wanted = PlanarVelocity(0.5, 0.0, 0.0)
    speeds = [guard.slowed(south, REST, wanted, doubt).x for doubt in (0.0, 0.4, 0.6, 0.8)]
    assert speeds[0] == 0.5
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[2] < 0.5
    assert speeds[3] < speeds[2]
