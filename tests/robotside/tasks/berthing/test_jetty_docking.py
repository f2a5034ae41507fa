"""Docking at a jetty, ticked by hand, against where the jetty really is."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.pose2 import Pose2
from robotside.tasks.berthing.jetty_docking import GATE, MAX_ASKEW, MAX_TRIES
from tests.robotside.tasks.berthing.harbour import FRONT, Harbour


def test_what_is_not_seen_is_not_sailed_into_and_it_says_so_away_from_it() -> None:
    on = Harbour()
    on.hidden = True
    assert on.run(on.make(), 900.0) is Status.FAILURE
    assert on.reason == (
        "Jetty is not seen: no tag of a dock is where it should be; after 4 tries the robot lies before it."
    )
    assert not on.touches
    assert on.within.x < -4.0
    assert on.at_rest


@pytest.mark.parametrize("turned", [-10, 10])
@pytest.mark.parametrize("off", [(0.3, 0.0), (0.0, 0.3), (-0.2, -0.2)])
@pytest.mark.parametrize("stream", [(0.0, 0.0), (0.08, 0.03), (-0.06, 0.02)])
def test_it_comes_in_on_the_line_and_touches_softly_wherever_the_map_has_the_jetty(
    off: tuple[float, float], turned: int, stream: tuple[float, float]
) -> None:
    on = Harbour(
        Pose2(*off, math.radians(turned)), Pose2(-7.0, 0.5, 0.2), stream=stream, drift=(0.015, -0.02)
    )
    assert on.run(on.make(), 400.0) is Status.SUCCESS, on.reason
    assert on.hits == 0
    assert max(on.touches, default=0.0) < 0.15
    assert abs(on.within.y + FRONT * math.sin(on.within.yaw)) < 0.2
    assert on.situation.charging
    assert on.at_rest


def test_from_two_metres_before_it_it_goes_for_room_first_and_docks() -> None:
    on = Harbour(start=Pose2(-2.0, 0.1, 0.1))
    assert on.run(on.make(), 400.0) is Status.SUCCESS
    assert on.hits == 0


def test_far_beside_the_line_it_comes_round_to_the_line_that_it_saw() -> None:
    on = Harbour(start=Pose2(-6.0, 2.0, -0.1))
    tree = on.make()
    on.until(tree, "Coming up")
    on.here = on.believed = on.jetty.then(Pose2(-3.9, 1.6, 0.0))
    on.until(tree, "Heading")
    assert on.goals
    assert on.run(tree, 400.0) is Status.SUCCESS
    assert on.hits == 0


def test_who_is_off_the_line_at_the_fingers_goes_back_before_it_touches_them() -> None:
    on = Harbour()
    tree = on.make()
    on.until(tree, "Coming up")
    while on.within.x < -0.98:
        assert on.tick(tree) is Status.RUNNING
    on.here = on.believed = on.jetty.then(Pose2(-0.97, 0.3, 0.0))
    on.until(tree, "Going back")
    assert not on.touches
    assert on.run(tree, 300.0) is Status.SUCCESS


def test_who_is_askew_at_the_fingers_goes_back_though_it_is_on_the_line() -> None:
    for askew, goes_back in ((MAX_ASKEW + 0.03, True), (MAX_ASKEW - 0.05, False)):
        on = Harbour()
        tree = on.make()
        on.until(tree, "Coming up")
        while on.within.x < -GATE - 0.01:
            assert on.tick(tree) is Status.RUNNING
        on.here = on.believed = on.jetty.then(Pose2(-GATE + 0.01, 0.0, askew))
        on.turning = 0.0
        told = set[str]()
        for _ in range(5):
            assert on.tick(tree) is Status.RUNNING
            told.add(on.situation.doing.text[:10])
        assert ("Going back" in told) is goes_back


def test_who_sees_the_tag_no_more_before_the_fingers_goes_back() -> None:
    on = Harbour()
    tree = on.make()
    on.until(tree, "Coming up")
    while on.within.x < -2.0:
        assert on.tick(tree) is Status.RUNNING
    on.hidden = True
    on.until(tree, "Going back")
    assert on.within.x < -0.6
    assert not on.touches


def test_contacts_that_do_not_meet_are_tried_anew_and_it_ends_clear_of_the_jetty() -> None:
    on = Harbour(gives=2)
    assert on.run(on.make(), 900.0) is Status.FAILURE
    assert len(on.touches) >= MAX_TRIES
    assert on.reason == (
        "Jetty was reached by its tag, but its contacts did not meet; after 4 tries the robot lies before it."
    )
    assert on.within.x < -5.0
    assert on.at_rest


def test_a_dead_jetty_is_told_at_the_first_try() -> None:
    on = Harbour(gives=3)
    assert on.run(on.make(), 400.0) is Status.FAILURE
    assert (
        on.reason == "Jetty gives no charge: the contacts meet, but no current flows; the robot stays there."
    )
    assert on.at_rest


def test_moved_in_a_pause_it_begins_anew() -> None:
    on = Harbour()
    tree = on.make()
    on.until(tree, "Coming up")
    on.alone(20.0)
    on.here = on.believed = on.jetty.then(Pose2(-7.0, 4.0, 1.5))
    assert on.tick(tree) is Status.RUNNING
    assert on.situation.doing.text == "Heading for Jetty."
    assert on.run(tree, 400.0) is Status.SUCCESS
    assert on.hits == 0


def test_left_alone_between_the_fingers_it_comes_out_before_it_comes_in_again() -> None:
    on = Harbour()
    tree = on.make()
    on.until(tree, "Coming up")
    while on.within.x < -0.4:
        assert on.tick(tree) is Status.RUNNING
    on.alone(5.0)
    assert on.tick(tree) is Status.RUNNING
    assert on.situation.doing.text.startswith("Going back")
    assert on.run(tree, 400.0) is Status.SUCCESS
    assert on.hits == 0


def test_what_holds_it_before_the_jetty_ends_the_try() -> None:
    on = Harbour()
    tree = on.make()
    on.until(tree, "Coming up")
    while on.within.x < -0.5:
        assert on.tick(tree) is Status.RUNNING
    on.stuck = True
    on.until(tree, "Going back", 30.0)
    on.stuck = False
    assert on.run(tree, 400.0) is Status.SUCCESS


def test_who_charges_there_already_stays_and_a_charge_elsewhere_is_none_of_it() -> None:
    on = Harbour(start=Pose2(0.0, 0.0, 0.0))
    tree = on.make()
    assert on.run(tree, 10.0) is Status.SUCCESS
    assert {order.kind for order in on.orders if isinstance(order, Manoeuvre)} == {"steer"}
    on = Harbour(start=Pose2(-9.0, 6.0, 0.0))
    tree = on.make()
    on.tick(tree)
    on.situation.charging = True
    tree.tick_once()
    assert on.situation.doing.text == "Heading for Jetty."


def test_it_is_done_only_after_some_seconds_of_charge() -> None:
    on = Harbour(start=Pose2(-6.5, 0.0, 0.0))
    tree = on.make()
    on.until(tree, "Waiting for the charge")
    for _ in range(60):
        assert on.tick(tree) is Status.RUNNING
    assert on.run(tree, 5.0) is Status.SUCCESS


def test_it_is_slow_where_it_is_near_and_brakes_before_the_jetty() -> None:
    on = Harbour(Pose2(0.0, 0.2, 0.1))
    tree = on.make()
    while on.tick(tree) is Status.RUNNING:
        speed = math.hypot(*on.velocity)
        assert on.within.x < -1.5 or speed < 0.35
        assert on.within.x < -0.15 or speed < 0.12
    assert tree.status is Status.SUCCESS
