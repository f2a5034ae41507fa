"""Docking in a cage, ticked by hand, against where the cage really is."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from robotside.core.pose2 import ORIGIN, Pose2
from robotside.tasks.berthing.cage_docking import MAX_TRIES
from tests.robotside.tasks.berthing.water import CAGE, Water


def test_what_is_not_seen_is_not_swum_into_and_it_says_so_before_it() -> None:
    on = Water()
    on.hidden = True
    tree = on.make()
    assert on.run(tree, 400.0) is Status.FAILURE
    assert on.reason == (
        "Cage is not seen: no tag of a cage is where it should be; the robot keeps its depth there."
    )
    assert not on.entered
    assert on.within.x < -1.2
    assert on.orders[-1].kind == "hover"


def test_who_cannot_get_onto_the_line_goes_in_nowhere() -> None:
    on = Water(start=Pose2(-1.6, 0.5, 0.0))
    tree = on.make()
    on.until(tree, "Coming up")
    while on.within.x < -0.9:
        assert on.tick(tree) is Status.RUNNING
    on.here = on.believed = on.cage.then(Pose2(on.within.x, 0.22, 0.0))
    on.until(tree, "Going back")
    assert not on.entered
    assert on.run(tree, 300.0) is Status.SUCCESS
    assert on.hits == 0


@pytest.mark.parametrize("turned", [-10, 10])
@pytest.mark.parametrize("off", [(0.3, 0.0), (0.0, 0.3), (-0.2, -0.2)])
@pytest.mark.parametrize("stream", [0.0, 0.06])
def test_from_two_metres_it_comes_in_on_the_line_wherever_the_map_has_the_cage(
    off: tuple[float, float], turned: int, stream: float
) -> None:
    along = CAGE.yaw + math.radians(turned)
    on = Water(
        Pose2(*off, math.radians(turned)),
        Pose2(-2.2, 0.3, 0.2),
        stream=(stream * math.cos(along), stream * math.sin(along)),
        drift=(0.015, -0.02),
    )
    tree = on.make()
    assert on.run(tree, 400.0) is Status.SUCCESS
    assert on.hits == 0
    assert on.entered[-1] < 0.12
    before = on.within
    on.run(tree, 0.0)
    assert math.hypot(*on.velocity) < 0.03
    assert abs(before.y) < 0.15


def test_a_cage_that_hangs_deeper_than_the_map_says_is_entered_at_its_depth() -> None:
    on = Water(deeper=0.3)
    assert on.run(on.make(), 400.0) is Status.SUCCESS
    assert on.z == pytest.approx(CAGE.height - 0.3, abs=0.1)


def test_coils_that_do_not_meet_are_tried_anew_from_before_the_cage() -> None:
    on = Water()
    on.meets = False
    assert on.run(on.make(), 900.0) is Status.FAILURE
    assert len(on.entered) == MAX_TRIES
    assert on.reason == (
        "Cage was reached by its tag, but its contacts did not meet; after 4 tries the robot keeps its depth there."
    )


def test_a_dead_cage_is_told_at_the_first_try() -> None:
    on = Water(current=False)
    assert on.run(on.make(), 400.0) is Status.FAILURE
    assert (
        on.reason == "Cage gives no charge: the contacts meet, but no current flows; the robot stays there."
    )
    assert len(on.entered) == 1


def test_a_silent_battery_in_the_cage_is_told_as_that_and_not_tried_again() -> None:
    on = Water()
    on.mute = True
    assert on.run(on.make(), 400.0) is Status.FAILURE
    assert on.reason == (
        "Cage was reached, but the battery says nothing, so nobody knows whether it charges; the robot stays there."
    )
    assert len(on.entered) == 1


def test_moved_aside_in_a_pause_it_goes_before_the_cage_again() -> None:
    on = Water()
    tree = on.make()
    on.until(tree, "Coming up")
    on.alone(tree, 20.0)
    on.here = on.believed = on.cage.then(Pose2(-1.0, 1.5, 1.0))
    assert on.tick(tree) is Status.RUNNING
    assert on.situation.doing.text == "Heading for Cage."
    assert on.run(tree, 400.0) is Status.SUCCESS
    assert on.hits == 0


def test_in_the_cage_it_is_slow_and_slower_still_at_the_coil() -> None:
    on = Water()
    tree, fastest = on.make(), 0.0
    while on.tick(tree) is Status.RUNNING:
        if on.within.x > -0.4:
            fastest = max(fastest, math.hypot(*on.velocity))
    assert tree.status is Status.SUCCESS
    assert fastest < 0.25


def test_it_is_done_only_when_it_lies_still_at_the_coil() -> None:
    on = Water(ORIGIN, Pose2(-2.0, 0.2, 0.0))
    assert on.run(on.make(), 400.0) is Status.SUCCESS
    assert math.hypot(*on.velocity) < 0.01


def test_who_charges_in_it_already_has_nothing_to_do() -> None:
    on = Water(start=Pose2(0.0, 0.0, 0.0))
    assert on.tick(on.make()) is Status.SUCCESS
    assert not [order for order in on.orders if order.kind == "course"]
