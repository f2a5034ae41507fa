"""Getting there: round what is on the map, round what is not, and honest when there is no way."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from robotside.core.pose2 import Pose2
from robotside.mapping.laser_points import LaserProjection
from robotside.mapping.occupancy_grid import Grid
from robotside.navigation.arrival_check import SURE_TIMEOUT
from robotside.navigation.navigator import Goal, LegState, Navigator
from tests.fakes import Box, FakeRobot, Pillar

PERIOD = 0.05


class Trip:
    """A guide on a robot that knows its pose exactly."""

    def __init__(self, robot: FakeRobot, clearance: float | None = None) -> None:
        self.robot = robot
        self.now = 0.0
        self.plans: list[np.ndarray] = []
        self.navigator = Navigator(robot, Grid.from_msg(robot.map()), self.plans.append, clearance=clearance)
        self._laser = LaserProjection()
        self._points = np.empty((0, 2))
        self.room = math.inf
        self._read()

    def go(self, goal: Goal, limit: float = 120.0) -> LegState:
        self.navigator.head_for(goal)
        end = self.now + limit
        leg = LegState.UNDER_WAY
        while leg is LegState.UNDER_WAY and self.now < end:
            leg = self.navigator.update(Pose2(*self.robot.pose), self._points, self.now)
            self.now += PERIOD
            self._read()
        self.navigator.rest()
        return leg

    def _read(self) -> None:
        for topic, msg in self.robot.read(self.now):
            if topic == "/scan":
                self._points = self._laser.points(msg)  # type: ignore[arg-type]
                self.navigator.obstacles.update(Pose2(*self.robot.pose).apply(self._points), self.now)
                self.room = min(self.room, self.robot.room())


def trip(
    *,
    boxes: Sequence[Box] = (),
    pillars: Sequence[Pillar] = (),
    start: tuple[float, float, float] = (-6.0, 0.0, 0.0),
    clearance: float | None = None,
) -> Trip:
    return Trip(FakeRobot(start=start, boxes=boxes, pillars=pillars), clearance)


def arrived(robot: FakeRobot, goal: Goal) -> bool:
    return math.hypot(robot.pose[0] - goal.x, robot.pose[1] - goal.y) < 0.15


def test_it_reaches_a_goal_in_the_open_and_rests_there() -> None:
    run = trip()
    goal = Goal("Point 1", 5.0, 2.0)
    assert run.go(goal) is LegState.ARRIVED
    assert arrived(run.robot, goal)
    assert run.robot.at_rest


def test_it_turns_to_the_direction_asked_for() -> None:
    run = trip()
    assert run.go(Goal("Point 1", -3.0, 0.0, math.pi / 2)) is LegState.ARRIVED
    assert run.robot.pose[2] == pytest.approx(math.pi / 2, abs=0.06)


def test_a_goal_behind_is_reached_without_a_wide_turn() -> None:
    run = trip(start=(-6.0, 0.0, math.pi))
    assert run.go(Goal("Point 1", -3.0, 0.0)) is LegState.ARRIVED
    assert run.now < 15.0


def test_it_goes_round_what_is_on_the_map() -> None:
    run = trip(boxes=[Box(-2.0, -3.0, 2.0, 3.0)])
    goal = Goal("Point 1", 6.0, 0.0)
    assert run.go(goal) is LegState.ARRIVED
    assert arrived(run.robot, goal)
    assert run.room > 0.1


@pytest.mark.parametrize("aside", [-0.3, -0.1, 0.0, 0.1, 0.3])
def test_it_passes_a_pillar_that_is_not_on_the_map_without_contact(aside: float) -> None:
    run = trip(pillars=[Pillar(0.0, aside)])
    goal = Goal("Point 1", 6.0, 0.0)
    assert run.go(goal) is LegState.ARRIVED
    assert arrived(run.robot, goal)
    assert run.room > 0.05


def test_it_passes_a_row_of_pillars_without_contact() -> None:
    run = trip(
        pillars=[Pillar(-3.0, 0.1), Pillar(-1.5, -0.4), Pillar(0.0, 0.3), Pillar(2.0, 0.0), Pillar(3.5, -0.2)]
    )
    goal = Goal("Point 1", 6.0, 0.0)
    assert run.go(goal) is LegState.ARRIVED
    assert run.room > 0.05


def test_it_passes_a_gap_that_is_not_much_wider_than_itself() -> None:
    run = trip(pillars=[Pillar(0.0, y) for y in np.arange(-6.0, 6.1, 0.2).tolist() if abs(y) > 0.55])
    goal = Goal("Point 1", 6.0, 0.0)
    assert run.go(goal) is LegState.ARRIVED
    assert run.room > 0.05


def test_a_pillar_that_appears_right_ahead_is_not_hit() -> None:
    run = trip()
    run.navigator.head_for(Goal("Point 1", 6.0, 0.0))
    run.go(Goal("Point 1", 6.0, 0.0), limit=4.0)
    x, y, _ = run.robot.pose
    run.robot.pillars.append(Pillar(x + 0.8, y))
    goal = Goal("Point 1", 6.0, 0.0)
    assert run.go(goal) is LegState.ARRIVED
    assert run.room > 0.02


def test_a_way_that_is_closed_by_something_new_is_given_up_with_a_sentence() -> None:
    run = trip(pillars=[Pillar(0.0, y) for y in np.arange(-6.0, 6.1, 0.2).tolist()])
    assert run.go(Goal("Point 2", 6.0, 0.0), limit=200.0) is LegState.BLOCKED
    assert "point 2 at (6.0, 0.0)" in run.navigator.reason.lower()
    assert run.room > 0.05
    assert run.robot.at_rest


def test_a_goal_behind_closed_walls_is_unreachable_at_once() -> None:
    walls = [
        Box(2.0, -2.0, 6.0, -1.5),
        Box(2.0, 1.5, 6.0, 2.0),
        Box(2.0, -2.0, 2.5, 2.0),
        Box(5.5, -2.0, 6.0, 2.0),
    ]
    run = trip(boxes=walls)
    assert run.go(Goal("Point 4", 4.0, 0.0)) is LegState.BLOCKED
    assert run.navigator.reason == "There is no way to Point 4 at (4.0, 0.0)."


def test_with_an_unsure_position_it_creeps() -> None:
    run = trip()
    run.navigator.sure = False
    run.go(Goal("Point 1", 6.0, 0.0), limit=5.0)
    speeds = [twist.linear.x for twist in run.robot.commands if twist is not None]
    assert max(speeds) <= 0.15


def test_at_a_goal_that_is_not_sure_it_stands_until_it_gives_up() -> None:
    run = trip()
    run.navigator.sure = False
    goal = Goal("Point 1", -3.0, 0.0)
    assert run.go(goal) is LegState.BLOCKED
    assert run.navigator.reason.code == Code.TASK_PLACE_UNSURE
    waited = run.robot.commands[-round(SURE_TIMEOUT / PERIOD) :]
    assert all(twist is None or twist == Twist() for twist in waited)


def test_a_leg_goes_on_after_a_rest_from_wherever_the_robot_is_then() -> None:
    run = trip()
    goal = Goal("Point 1", 6.0, 0.0)
    run.go(goal, limit=3.0)
    run.robot.pose = (-2.0, 3.0, 2.0)
    assert run.go(goal) is LegState.ARRIVED
    assert arrived(run.robot, goal)


def test_after_the_last_leg_there_is_no_plan_to_show() -> None:
    run = trip()
    run.go(Goal("Point 1", -3.0, 0.0))
    run.navigator.finish()
    assert len(run.plans[-1]) == 0


def wall_with_a_gap(width: float, at: float = 0.0, thick: float = 0.06) -> list[Pillar]:
    """Across the hall, of things that are not on the map, with one gap."""
    beside = width / 2 + thick
    rows = [*np.arange(at + beside, 6.0, 0.1).tolist(), *np.arange(at - beside, -6.0, -0.1).tolist()]
    return [Pillar(0.0, y, thick) for y in rows]


@pytest.mark.parametrize("at", [0.0, 0.03, 0.77, -1.42])
@pytest.mark.parametrize("width", [0.5, 0.55, 0.65])
def test_a_gap_of_half_a_metre_is_passed_slowly_and_without_contact(width: float, at: float) -> None:
    run = trip(pillars=wall_with_a_gap(width, at), start=(-3.0, 0.0, 0.0))
    goal = Goal("Point 1", 3.0, 0.0)
    assert run.go(goal) is LegState.ARRIVED
    assert run.room > 0.02


@pytest.mark.parametrize("at", [0.0, 0.04])
def test_a_gap_that_is_too_narrow_is_refused_with_its_width_and_the_one_that_is_needed(at: float) -> None:
    run = trip(pillars=wall_with_a_gap(0.4, at), start=(-2.0, 0.0, 0.0))
    assert run.go(Goal("Point 1", 3.0, 0.0)) is LegState.BLOCKED
    assert "the gap at (" in run.navigator.reason
    assert "is 0.4" in run.navigator.reason
    assert "m wide and the robot needs 0.46 m" in run.navigator.reason
    assert run.room > 0.1


@pytest.mark.parametrize(
    ("clearance", "width", "passes"),
    [(0.12, 0.66, True), (0.3, 0.9, False)],
)
def test_a_gap_is_passed_or_refused_by_the_clearance_that_is_set(
    clearance: float, width: float, passes: bool
) -> None:
    run = trip(pillars=wall_with_a_gap(width, 0.03), start=(-2.0, 0.0, 0.0), clearance=clearance)
    leg = run.go(Goal("Point 1", 2.0, 0.0))
    if passes:
        assert leg is LegState.ARRIVED
        assert run.room > 0.5 * clearance
    else:
        assert leg is LegState.BLOCKED
        assert f"the robot needs {0.36 + 2 * clearance:.2f} m" in run.navigator.reason
        assert run.room > clearance


def test_a_wide_clearance_is_kept_from_what_appears_beside_the_way_as_well() -> None:
    run = trip(pillars=[Pillar(0.0, 0.4), Pillar(2.0, -0.45)], clearance=0.4)
    assert run.go(Goal("Point 1", 5.0, 0.0)) is LegState.ARRIVED
    assert run.room > 0.24  # the share that avoidance itself keeps


@pytest.mark.parametrize(("depth", "width"), [(0.4, 1.3), (0.4, 1.0), (0.3, 1.0), (0.3, 0.9), (0.2, 0.75)])
def test_a_box_that_stands_against_a_wall_of_a_corridor_is_passed_without_contact(
    depth: float, width: float
) -> None:
    """What is nearer than 0.35 m to a wall is not remembered, as the wall itself is seen there; the laser keeps off it all the same."""
    walls = [Box(-4.0, -6.0, 4.0, -width / 2), Box(-4.0, width / 2, 4.0, 6.0)]
    face = -width / 2 + depth
    box = [Pillar(x, y, 0.03) for x in np.arange(-0.3, 0.31, 0.05) for y in (face - 0.03, face - 0.1)]
    run = trip(boxes=walls, pillars=box, start=(-5.0, 0.0, 0.0))
    assert run.go(Goal("Point 1", 5.0, 0.0)) is LegState.ARRIVED
    assert run.room > 0.02


def test_before_a_box_against_a_wall_that_leaves_no_room_it_stands_and_gives_up() -> None:
    walls = [Box(-4.0, -6.0, 4.0, -0.35), Box(-4.0, 0.35, 4.0, 6.0)]
    box = [Pillar(x, y, 0.03) for x in np.arange(-0.3, 0.31, 0.05) for y in (-0.03, -0.1)]
    run = trip(boxes=walls, pillars=box, start=(-3.0, 0.0, 0.0))
    assert run.go(Goal("Point 1", 5.0, 0.0)) is LegState.BLOCKED
    assert run.room > 0.02
    assert run.robot.at_rest
