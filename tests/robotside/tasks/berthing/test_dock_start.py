"""Where going up to a dock begins, by what stands round it."""

from __future__ import annotations

import math

import pytest

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.tasks.berthing.dock_start import DockStarts, Fault, before, body_fault, starts

DOCK = Place(1, "Dock", "dock", x=0.0, y=0.0, yaw=0.0)
DOCKED = Pose2(0.0, 0.0, 0.0)
FAR = (6.0, 7.5, 5.0, 4.0)
SLANTS = (0.0, 0.1, -0.1, 0.2, -0.2)
BODY = (0.0, 1.0, 2.0)


def round_trees(*trees: tuple[float, float]) -> Fault:
    """Nothing may stand within 1 m of one."""

    def fault(name: str, x: float, y: float) -> Problem:
        near = any(math.dist((x, y), tree) < 1.0 for tree in trees)
        said = f"{name} at ({x:.1f}, {y:.1f}) is too near."
        return Notice(Code.PLACE_NEAR_OBSTACLE, said, place=name, x=x, y=y) if near else ""

    return fault


def found(fault: Fault) -> list[tuple[float, float]]:
    """Distance [m] and direction [rad] of the line of each."""
    goals = starts(DOCK, DOCKED, FAR, fault, slants=SLANTS, discs=BODY)
    for goal in goals:
        assert math.atan2(-goal.y, -goal.x) == pytest.approx(goal.yaw)
    return [(round(math.hypot(goal.x, goal.y), 3), round(goal.yaw, 3)) for goal in goals]


def test_with_room_all_round_it_begins_on_the_line_as_the_distances_are_ordered() -> None:
    assert found(round_trees())[:5] == [(6.0, 0.0), (7.5, 0.0), (5.0, 0.0), (4.0, 0.0), (6.0, 0.1)]
    assert len(found(round_trees())) == len(FAR) * len(SLANTS)


def test_a_tree_that_only_the_front_of_the_body_would_meet_is_kept_off() -> None:
    """At 6 m its middle has 2 m of room, and its front none."""
    assert found(round_trees((-4.0, 0.5)))[0] == (6.0, 0.2)
    at = before(DOCK, DOCKED, 6.0)
    assert not body_fault("It", at, round_trees((-4.0, 0.5)), BODY[:1])
    assert body_fault("It", at, round_trees((-4.0, 0.5)), BODY) == "It at (-4.0, 0.0) is too near."


def test_a_line_with_a_tree_beside_it_nearer_to_the_dock_comes_after_the_free_ones() -> None:
    """The tree is beside the line where it goes on to the dock."""
    goals = found(round_trees((-2.6, 0.9)))
    assert goals[0] == (6.0, 0.1)
    assert goals.index((6.0, 0.2)) < goals.index((6.0, 0.0))


def test_where_none_has_room_the_nearest_on_the_line_is_left() -> None:
    assert found(lambda name, x, y: round_trees((x, y))(name, x, y)) == [(4.0, 0.0)]


def test_what_leads_to_nothing_is_not_begun_at_twice_before_all_others_were() -> None:
    goals = [before(DOCK, DOCKED, distance) for distance in (6.0, 5.8, 5.0, 4.0)]
    places = DockStarts(lambda _: goals, varied=True)
    assert [-places.next(DOCKED).x for _ in range(5)] == [6.0, 5.0, 4.0, 6.0, 5.0]
    assert places.other(DOCKED) is goals[3]
    assert places.other(DOCKED) is None
    places.forget()
    assert places.next(DOCKED) is goals[0]


def test_one_that_turns_on_the_spot_begins_at_the_best_again_and_again() -> None:
    goals = [before(DOCK, DOCKED, distance) for distance in (2.0, 1.2)]
    places = DockStarts(lambda _: goals, varied=False)
    assert [-places.next(DOCKED).x for _ in range(3)] == [2.0, 2.0, 2.0]
    assert places.other(DOCKED) is None
