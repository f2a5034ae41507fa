"""Landing on a pad, ticked by hand, against where the pad really lies."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from robotside.tasks.berthing.pad_landing import MAX_TRIES, SEARCH_HEIGHT
from tests.robotside.tasks.berthing.air import PAD, Air


def test_what_is_not_seen_is_not_landed_on_and_it_says_so_in_the_air() -> None:
    on = Air()
    on.hidden = True
    tree = on.make()
    assert on.run(tree, 400.0) is Status.FAILURE
    assert on.reason == "Pad is not seen: no tag of a pad is where it should be; the robot hovers there."
    assert not on.landings
    assert on.z == pytest.approx(SEARCH_HEIGHT, abs=0.1)
    assert on.lowest_unseen > 2.0


def test_out_of_sight_it_sinks_no_farther_but_goes_up_to_look_again() -> None:
    on = Air((0.5, 0.3))
    tree = on.make()
    on.until(tree, "Going down")
    while on.z > 1.6:
        on.tick(tree)
    on.hidden = True
    on.run(tree, 0.8)
    stopped = on.z
    on.until(tree, "Looking")
    assert on.z > stopped + 0.4
    on.run(tree, 2.0)
    assert not on.landings
    on.hidden = False
    assert on.run(tree, 200.0) is Status.SUCCESS


@pytest.mark.parametrize("off", [(0.0, 0.0), (0.8, -0.5), (-0.9, 0.9), (0.1, -2.6)])
def test_it_comes_down_on_the_middle_wherever_the_map_has_the_pad(off: tuple[float, float]) -> None:
    on = Air(off)
    assert on.run(on.make(), 400.0) is Status.SUCCESS
    assert on.landings == [pytest.approx(0.0, abs=0.1)]
    assert on.flight == "landed"


def test_contacts_that_do_not_meet_are_tried_three_times_from_above() -> None:
    on = Air()
    on.reach = -1.0
    tree, heights = on.make(), list[float]()
    while on.tick(tree) is Status.RUNNING:
        if len(on.landings) > len(heights):
            heights.append(0.0)
        if heights:
            heights[-1] = max(heights[-1], on.z)
    assert len(on.landings) == MAX_TRIES
    assert all(height > 1.5 for height in heights[:-1])
    assert tree.status is Status.FAILURE
    assert on.reason == (
        "Pad was reached by its tag, but its contacts did not meet; after 3 tries the robot stands there."
    )


def test_a_dead_pad_is_told_at_the_first_landing() -> None:
    on = Air(current=False)
    assert on.run(on.make(), 200.0) is Status.FAILURE
    assert on.reason == "Pad gives no charge: the contacts meet, but no current flows; the robot stays there."
    assert len(on.landings) == 1


def test_a_silent_battery_on_the_pad_is_told_as_that_and_not_tried_again() -> None:
    on = Air()
    on.mute = True
    assert on.run(on.make(), 200.0) is Status.FAILURE
    assert on.reason == (
        "Pad was reached, but the battery says nothing, so nobody knows whether it charges; the robot stays there."
    )
    assert len(on.landings) == 1
    assert on.flight == "landed"


def test_moved_aside_in_a_pause_while_it_lands_it_does_not_land_there() -> None:
    on = Air()
    tree = on.make()
    on.until(tree, "Landing")
    on.alone(tree, 20.0)
    on.x += 1.5
    assert on.tick(tree) is Status.RUNNING
    assert on.flight == "flying"
    assert on.situation.doing.text == "Looking for Pad."
    assert on.run(tree, 200.0) is Status.SUCCESS
    assert on.landings == [pytest.approx(0.0, abs=0.1)]


def test_carried_far_away_in_a_pause_it_flies_there_again() -> None:
    on = Air()
    tree = on.make()
    on.until(tree, "Going down")
    on.alone(tree, 20.0)
    on.x, on.y = -3.0, -3.0
    on.tick(tree)
    assert on.situation.doing.text == "Heading for Pad."
    assert on.run(tree, 200.0) is Status.SUCCESS


def test_who_stands_on_the_pad_and_charges_has_nothing_to_do() -> None:
    on = Air()
    on.x, on.y = on.pad
    tree = on.make()
    assert on.tick(tree) is Status.SUCCESS
    assert on.z == 0.0


def test_it_looks_from_nowhere_beyond_a_wall() -> None:
    on = Air()
    on.hidden = True
    on.walls = [(PAD.x + 1.6, PAD.y, 0.7)]
    tree, nearest = on.make(), math.inf
    while on.tick(tree) is Status.RUNNING:
        nearest = min(nearest, math.hypot(on.x - on.walls[0][0], on.y - on.walls[0][1]))
    assert nearest > 0.65


def test_over_a_platform_that_is_on_the_map_it_flies_and_nowhere_else() -> None:
    on = Air()
    on.walls = [(PAD.x, PAD.y, 1.4)]
    tree = on.make()
    assert on.run(tree, 200.0) is Status.SUCCESS
    assert on.landings == [pytest.approx(0.0, abs=0.1)]


def test_it_wants_pictures_of_the_ground_only_while_it_is_at_it() -> None:
    on = Air()
    tree = on.make()
    on.tick(tree)
    assert on.situation.looks_down
    on.run(tree, 200.0)
    assert not on.situation.looks_down
