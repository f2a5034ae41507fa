"""Docking, ticked by hand, against where the dock really stands."""

from __future__ import annotations

import math

import pytest
from py_trees.common import Status

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Place
from bridge.msgs.sensor_msgs import BatteryState, LaserScan
from robotside.core.pose2 import ORIGIN, Pose2
from robotside.navigation.navigator import Goal
from robotside.perception.dock_finder import DockFinder, DockSighting, Expected
from robotside.perception.dock_track import DockTrack
from robotside.tasks.behaviours.course import Course
from robotside.tasks.berthing.approach import Approach
from robotside.tasks.berthing.dock import APPROACH_TIMEOUT, MAX_OUTS, MAX_TRIES, Dock
from robotside.tasks.berthing.dock_start import DockStarts, before
from tests.fakes import Box, FakeDock, FakeRobot, Pillar
from tests.robotside.tasks.behaviours.stage import Stage

RADIUS = 0.18
DOCK = Place(1, "Dock", "dock", x=4.0, y=1.0, yaw=0.0)
"""Where the robot stands docked, as the map has it."""

WALLED = Box(0.7, 0.7, 1.3, 1.3)
"""It stands on the place 3 m before the dock."""

MAP_ERROR = Pose2(0.2, 0.22, math.radians(10))
"""Of 0.3 m and 10 degrees."""


def stage(off: Pose2 = ORIGIN, *, pillars: tuple[Pillar, ...] = (), **words: object) -> Stage:
    dock = FakeDock(DOCK.x + RADIUS, DOCK.y, DOCK.yaw, **words)  # type: ignore[arg-type]
    made = Stage(robot=FakeRobot(beams=360, dock=dock, pillars=pillars))
    made.off = off
    return made


def make(on: Stage, distance: float = 2.0) -> Dock:
    return build(on, Approach.of(on.robot.info), DockFinder(), distance)


def build(on: Stage, way: Approach, finder: DockFinder, *distances: float) -> Dock:
    def begin(docked: Pose2) -> list[Goal]:
        return [before(DOCK, docked, distance) for distance in distances]

    course = Course(begin(Pose2(DOCK.x, DOCK.y, DOCK.yaw)))
    course.index = 0
    starts = DockStarts(begin, varied=way.min_radius > 0)
    return Dock(DOCK, course, on.navigator, on.situation, way, DockTrack(finder), starts)


def until(on: Stage, tree: Dock, phase: str, limit: float = 60.0) -> None:
    end = on.situation.now + limit
    while on.phase != phase and on.situation.now < end:
        assert on.tick(tree) is Status.RUNNING
    assert on.phase == phase


def finish(on: Stage, tree: Dock, limit: float = 400.0) -> Status:
    status = on.tick(tree, limit)
    assert status is not Status.RUNNING, on.situation.doing
    assert on.robot.at_rest
    return status


def test_it_drives_two_metres_before_the_dock_and_goes_up_to_it_until_it_charges() -> None:
    on = stage()
    tree = make(on)
    until(on, tree, "driving")
    until(on, tree, "docking")
    assert on.robot.pose[:2] == pytest.approx((2.0, 1.0), abs=0.25)
    assert finish(on, tree) is Status.SUCCESS
    assert on.robot.pose[:2] == pytest.approx((4.0, 1.0), abs=0.03)


@pytest.mark.parametrize("side", [1, -1])
def test_it_docks_though_the_map_is_off_by_thirty_centimetres_and_ten_degrees(side: int) -> None:
    on = stage(Pose2(MAP_ERROR.x, side * MAP_ERROR.y, side * MAP_ERROR.yaw))
    assert finish(on, make(on)) is Status.SUCCESS
    assert on.robot.pose[:2] == pytest.approx((4.0, 1.0), abs=0.03)


def test_by_the_map_only_it_docks_where_the_map_is_right_and_says_that_it_goes_by_it() -> None:
    on = stage(strips=(), aside=0.05)
    on.blind = True
    tree = make(on)
    until(on, tree, "docking")
    on.tick(tree, 1.0)
    assert on.situation.doing.text == "Going up to Dock, by the map only."
    assert finish(on, tree) is Status.SUCCESS


def test_what_is_not_seen_is_not_driven_at_and_said_after_three_looks() -> None:
    on = stage(strips=())
    assert finish(on, make(on)) is Status.FAILURE
    assert on.navigator.reason == (
        "Dock is not seen: no two reflecting strips 0.30 m apart are where it should be; "
        "after 3 tries the robot stands before it."
    )
    assert on.robot.contacts == 0
    assert on.robot.pose[0] < 2.5


def test_a_dock_with_another_robot_in_it_is_told_to_be_taken() -> None:
    on = stage(pillars=(Pillar(DOCK.x, DOCK.y, 0.2),))
    assert finish(on, make(on)) is Status.FAILURE
    assert on.navigator.reason.startswith("Dock is taken: something stands in it")
    assert on.robot.contacts == 0


def test_contacts_that_do_not_meet_are_tried_three_times_from_two_metres() -> None:
    on = stage(aside=-1.0)
    tree, far, tries = make(on), False, 0
    for _ in range(20 * 600):
        if on.tick(tree) is not Status.RUNNING:
            break
        away = DOCK.x - on.robot.pose[0]
        tries += far and away < 0.1
        far = away > 1.5 or (far and away >= 0.1)
    assert tries == MAX_TRIES
    assert tree.status is Status.FAILURE
    assert on.robot.at_rest
    assert on.navigator.reason == (
        "Dock was reached by its reflectors, but its contacts did not meet; "
        "after 3 tries the robot stands before it."
    )


def test_a_dead_charger_is_told_at_the_first_contact() -> None:
    on = stage(gives=BatteryState.POWER_SUPPLY_STATUS_NOT_CHARGING)
    assert finish(on, make(on)) is Status.FAILURE
    assert on.navigator.reason == (
        "Dock gives no charge: the contacts meet, but no current flows; the robot stays there."
    )


def test_a_silent_battery_in_contact_is_told_as_that_and_not_tried_again() -> None:
    on = stage()
    on.mute = True
    assert finish(on, make(on), 120.0) is Status.FAILURE
    assert on.navigator.reason == (
        "Dock was reached, but the battery says nothing, so nobody knows whether it charges; the robot stays there."
    )
    assert on.robot.pose[:2] == pytest.approx((4.0, 1.0), abs=0.05)


def test_a_full_battery_at_the_dock_is_docked() -> None:
    on = stage(gives=BatteryState.POWER_SUPPLY_STATUS_FULL)
    assert finish(on, make(on)) is Status.SUCCESS


def test_it_waits_for_who_stands_in_the_way_and_goes_on_when_they_are_gone() -> None:
    on = stage()
    tree = make(on)
    until(on, tree, "docking")
    on.tick(tree, 1.0)
    on.robot.pillars.append(Pillar(3.2, 1.0, 0.1))
    on.tick(tree, 5.0)
    assert on.situation.doing.text == "Waiting: something stands before Dock."
    assert on.robot.at_rest
    assert not on.situation.touches
    assert on.robot.room() > 0.1
    on.robot.pillars.clear()
    assert finish(on, tree) is Status.SUCCESS


def test_who_never_leaves_the_way_is_never_touched() -> None:
    on = stage()
    tree = make(on)
    until(on, tree, "docking")
    on.tick(tree, 1.0)
    on.robot.pillars.append(Pillar(3.2, 1.0, 0.1))
    assert finish(on, tree) is Status.FAILURE
    assert "something stands" in on.navigator.reason
    assert on.robot.contacts == 0


def test_only_near_the_dock_a_touch_is_no_accident() -> None:
    on = stage()
    tree, touching = make(on), []
    while on.tick(tree) is Status.RUNNING:
        if on.situation.touches:
            touching.append(DOCK.x - on.robot.pose[0])
    assert 0.2 < max(touching) < 0.35


def test_pushed_aside_on_the_way_it_still_comes_in() -> None:
    on = stage(MAP_ERROR)
    tree = make(on)
    until(on, tree, "docking")
    on.tick(tree, 3.0)
    x, y, yaw = on.robot.pose
    on.robot.pose = (x, y + 0.06, yaw - 0.05)
    assert finish(on, tree) is Status.SUCCESS


def test_who_was_moved_away_while_it_was_paused_begins_anew() -> None:
    on = stage()
    tree = make(on)
    until(on, tree, "docking")
    on.tick(tree, 3.0)
    on.pause(30.0)
    on.robot.pose = (-1.0, 0.0, 0.0)
    until(on, tree, "driving")
    assert finish(on, tree) is Status.SUCCESS


def test_a_pause_in_contact_does_not_count_as_waiting_for_the_charge() -> None:
    on = stage(gives=0)
    tree = make(on)
    while on.situation.doing.text != "Waiting for the charge at Dock.":
        assert on.tick(tree) is Status.RUNNING
    on.pause(60.0)
    assert on.tick(tree, 1.0) is Status.RUNNING
    assert on.situation.doing.text == "Waiting for the charge at Dock."


def test_who_is_charging_at_the_dock_stays_there() -> None:
    on = stage()
    on.robot.pose = (DOCK.x, DOCK.y, DOCK.yaw)
    on.situation.charging = True
    assert on.tick(make(on)) is Status.SUCCESS


def test_a_dock_without_a_way_to_it_fails() -> None:
    on = Stage(Box(1.0, -6.0, 1.3, 6.0))
    assert on.tick(make(on), 5.0) is Status.FAILURE
    assert on.navigator.reason.startswith("There is no way to Dock at (2.0, 1.0)")


def going_up(on: Stage, tree: Dock, x: float) -> None:
    """Up to the `x` [m] of the map on its approach."""
    until(on, tree, "docking")
    while on.robot.pose[0] < x:
        assert on.tick(tree) is Status.RUNNING
    assert on.situation.doing.text.startswith("Going up to Dock")


def test_going_back_it_does_not_back_into_who_stands_there() -> None:
    on = stage(aside=-1.0)
    tree = make(on)
    while not on.situation.doing.text.startswith("Going back"):
        assert on.tick(tree) is Status.RUNNING
    on.tick(tree, 1.0)
    x, y, _ = on.robot.pose
    on.robot.pillars.append(Pillar(x - RADIUS - 0.12 - 0.2, y, 0.12))
    before_it = on.robot.contacts
    on.tick(tree, 4.0)
    assert on.robot.contacts == before_it
    assert not on.situation.doing.text.startswith("Going back")


def test_charge_that_it_takes_elsewhere_is_not_that_of_the_dock() -> None:
    on = stage()
    on.mute = on.situation.charging = True
    assert on.tick(make(on), 0.5) is Status.RUNNING


def test_what_it_touches_far_from_the_dock_is_not_the_dock() -> None:
    on = stage()
    tree = make(on)
    going_up(on, tree, 2.8)
    on.situation.touched = True
    on.tick(tree, 0.15)
    assert on.situation.doing.text.startswith("Going up to Dock")


def test_off_its_line_close_to_the_dock_it_goes_back_before_it_touches_it() -> None:
    on = stage()
    tree = make(on)
    going_up(on, tree, 3.72)
    x, y, yaw = on.robot.pose
    on.robot.pose = (x, y + 0.08, yaw)
    while on.situation.doing.text.startswith("Going up"):
        assert on.tick(tree) is Status.RUNNING
    assert on.situation.doing.text.startswith("Going back")
    assert on.robot.pose[0] < 3.95


def test_an_approach_that_takes_too_long_is_tried_again() -> None:
    on = stage()
    tree = make(on)
    going_up(on, tree, 2.8)
    on.robot.stop()
    on.situation.now += APPROACH_TIMEOUT
    on.tick(tree, 0.1)
    assert on.situation.doing.text.startswith("Going back")


def test_it_stands_while_it_looks_and_when_it_is_ended() -> None:
    on = stage(strips=())
    tree = make(on)
    while on.situation.doing.text != "Looking for Dock.":
        assert on.tick(tree) is Status.RUNNING
    on.robot.drive(Twist.planar(0.2, 0.0))
    on.tick(tree)
    assert on.robot.at_rest
    on = stage()
    tree = make(on)
    going_up(on, tree, 2.8)
    assert not on.robot.at_rest
    tree.stop(Status.INVALID)
    assert on.robot.at_rest


def test_too_far_beside_the_line_it_sets_out_anew_and_docks() -> None:
    on = stage()
    tree = make(on)
    going_up(on, tree, 2.8)
    x, y, yaw = on.robot.pose
    on.robot.pose = (x, y + 1.1, yaw)
    until(on, tree, "driving", 20.0)
    assert finish(on, tree) is Status.SUCCESS
    assert on.robot.pose[:2] == pytest.approx((4.0, 1.0), abs=0.03)


def test_who_is_pushed_beside_the_line_again_and_again_gives_up_before_the_dock() -> None:
    on = stage()
    tree, outs, pushed = make(on), 0, False
    for _ in range(20 * 1500):
        if on.tick(tree) is not Status.RUNNING:
            break
        x, y, yaw = on.robot.pose
        if on.phase == "driving" or on.situation.doing.text.startswith("Going back"):
            pushed = False
        elif on.situation.doing.text.startswith("Going up") and x > 2.3 and not pushed:
            on.robot.pose, outs, pushed = (x, y + 1.1, yaw), outs + 1, True
    assert tree.status is Status.FAILURE
    assert on.navigator.reason.startswith("No charge: the line to Dock was missed by 1")
    assert outs == MAX_TRIES * (MAX_OUTS + 1)
    assert on.robot.contacts == 0


class ShortSight(DockFinder):
    """A laser whose beams are too far apart to see strips from beyond `reach` [m]."""

    reach = 1.4

    def find(self, scan: LaserScan, expected: Expected) -> DockSighting | None:
        return super().find(scan, expected) if expected.pose.x < self.reach else None


def bending(
    on: Stage, *, look_gap: float = math.inf, radius: float = 0.8, distances: tuple[float, ...] = (2.0,)
) -> Dock:
    """For a robot that turns only by going."""
    way = Approach(RADIUS, RADIUS, RADIUS, radius, distances, look_gap=look_gap)
    finder = ShortSight() if look_gap < math.inf else DockFinder()
    return build(on, way, finder, *distances)


def test_it_comes_nearer_by_the_map_to_see_the_dock_and_docks() -> None:
    on = stage(Pose2(0.1, 0.1, 0.05))
    tree, nearest = bending(on, look_gap=0.7), math.inf
    while on.tick(tree) is Status.RUNNING:
        if on.situation.doing.text == "Looking for Dock.":
            nearest = min(nearest, DOCK.x - on.robot.pose[0])
    assert tree.status is Status.SUCCESS
    assert 0.9 < nearest < 1.5


def test_what_it_does_not_see_from_near_either_it_does_not_drive_at() -> None:
    on = stage(strips=())
    tree, nearest = bending(on, look_gap=0.7), math.inf
    while on.tick(tree) is Status.RUNNING:
        nearest = min(nearest, DOCK.x - on.robot.pose[0])
    assert tree.status is Status.FAILURE
    assert on.navigator.reason.startswith("Dock is not seen: no two reflecting strips")
    assert 0.6 < nearest < 0.8
    assert on.robot.contacts == 0


def test_coming_nearer_it_waits_for_who_stands_before_the_dock() -> None:
    on = stage(pillars=(Pillar(3.2, 1.0, 0.1),), strips=())
    tree = bending(on, look_gap=0.3)
    while on.situation.doing.text != "Waiting: something stands before Dock.":
        assert on.tick(tree) is Status.RUNNING
    assert on.robot.at_rest
    assert on.robot.contacts == 0


def test_where_no_bend_leads_onto_the_line_it_sets_out_anew_by_what_it_saw() -> None:
    on = stage(Pose2(0.1, 0.28, math.radians(10)))
    tree, texts, asides = bending(on, radius=2.0), [""], []
    while on.tick(tree) is Status.RUNNING:
        text = on.situation.doing.text
        if text != texts[-1]:
            texts.append(text)
            asides.append(abs(on.robot.pose[1] - DOCK.y))
    assert tree.status is Status.SUCCESS
    looks = [aside for text, aside in zip(texts[1:], asides, strict=True) if text == "Looking for Dock."]
    assert len(looks) == 2
    assert looks[0] > 0.3
    assert looks[1] < 0.2
    assert not any(text.startswith("Going back") for text in texts)


def legs(on: Stage, tree: Dock) -> tuple[Status, list[float]]:
    """How it ended; and where it headed for, leg by leg: so far before the dock [m]."""
    heads: list[float] = []
    head_for = on.navigator.head_for

    def noted(goal: Goal, *, patient: bool = True) -> None:
        heads.append(round(DOCK.x - goal.x, 2))
        head_for(goal, patient=patient)

    on.navigator.head_for = noted  # type: ignore[method-assign]
    return finish(on, tree), heads


def test_where_no_way_leads_to_one_place_before_the_dock_it_begins_at_another() -> None:
    on = Stage(robot=FakeRobot(beams=360, dock=FakeDock(DOCK.x + RADIUS, DOCK.y, DOCK.yaw), boxes=[WALLED]))
    status, heads = legs(on, bending(on, distances=(3.0, 2.0)))
    assert status is Status.SUCCESS
    assert heads == [3.0, 2.0]


def test_without_a_way_to_any_of_them_it_says_so() -> None:
    on = Stage(Box(1.0, -6.0, 1.3, 6.0))
    status, heads = legs(on, bending(on, distances=(2.6, 2.0, 1.4)))
    assert status is Status.FAILURE
    assert heads == [2.6, 2.0, 1.4]
    assert on.navigator.reason.startswith("There is no way to Dock at (2.6, 1.0)")


def test_it_tries_no_more_than_some_places_that_no_way_leads_to() -> None:
    on = Stage(Box(1.0, -6.0, 1.3, 6.0))
    status, heads = legs(on, bending(on, distances=(2.3, 1.75, 1.2, 0.65, 0.1)))
    assert status is Status.FAILURE
    assert len(heads) == MAX_OUTS + 1


def test_one_that_only_bends_comes_anew_from_elsewhere_where_something_stood_before_the_dock() -> None:
    on = stage(pillars=(Pillar(3.2, 1.0, 0.1),))
    status, heads = legs(on, bending(on, distances=(2.0, 2.8)))
    assert status is Status.FAILURE
    assert heads == [2.0, 2.8, 2.0]
    assert on.robot.contacts == 0
