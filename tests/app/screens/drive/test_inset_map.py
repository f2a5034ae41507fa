"""Map and picture on the drive screen: a tap swaps them, and driving goes on."""

from __future__ import annotations

import math
from typing import Any

import pytest

from app.layout import arrange
from app.layout.rects import Body, Rect
from app.screens.drive.inset_map import checks_beside, inset_place
from bridge.msgs.geometry_msgs import (
    Point,
    Point32,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
)
from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates, RobotInfo
from tests.app.glass import Glass

SIZES = {(412, 774): "tall", (824, 364): "short", (1204, 744): "wide", (1844, 1144): "wide"}


@pytest.fixture
def screen(driving: Glass) -> Any:
    """A tablet's drive screen."""
    screen = driving.app.screens["drive"]
    screen.arrange(Rect(76, 0, 1204, 744), "wide", 1.0)
    return screen


def place(widget: Any) -> Rect:
    return Rect(*widget.pos, *widget.size)


def swap(screen: Any) -> None:
    screen.inset.frame.dispatch("on_release")
    screen.arrange(Rect(76, 0, 1204, 744), "wide", 1.0)


def pose(x: float, y: float, yaw: float) -> PoseWithCovarianceStamped:
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, y), Quaternion.from_yaw(yaw))))


def test_a_tap_on_what_is_small_swaps_map_and_picture(screen):
    small, large = place(screen.inset.map), place(screen.video)
    assert large == screen.arranged["video"]
    assert large.holds(small)
    swap(screen)
    assert (place(screen.inset.map), place(screen.video)) == (large, small)
    swap(screen)
    assert (place(screen.inset.map), place(screen.video)) == (small, large)


def test_what_is_small_lies_on_what_is_large_and_every_control_above_both(screen):
    for _ in range(2):
        inset, order = screen.inset, list(reversed(screen.children))
        small, large = (screen.video, inset.map) if inset.large else (inset.map, screen.video)
        assert order[:3] == [large, small, inset.frame]
        assert order.index(screen.stick) > 3
        swap(screen)


def test_a_finger_on_the_stick_drives_on_while_another_swaps(driving, screen):
    stick, frame = screen.stick, screen.inset.frame
    held = driving.stage.touch(*stick.to_window(*stick.center))
    held.touch_down()
    held.touch_move(stick.center_x, stick.center_y + stick.height * 0.3)
    before = stick.forward, stick.left
    assert before[0] > 0
    tap = driving.stage.touch(*frame.to_window(*frame.center))
    tap.touch_down()
    driving.stage.frames(2)
    tap.touch_up()
    driving.stage.frames(30)
    assert screen.inset.large
    assert (stick.forward, stick.left) == before
    held.touch_up()
    driving.stage.frames(2)
    assert (stick.forward, stick.left) == (0, 0)


def test_a_finger_on_a_stick_over_a_large_map_moves_no_map(driving, screen):
    swap(screen)
    view, stick = screen.inset.map.view, screen.stick
    x, y = stick.to_window(*stick.center)
    driving.stage.drag([(x, y), (x + 30, y + 30), (x + 60, y)])
    assert screen.inset.map.view == view


def test_the_small_map_keeps_the_robot_in_its_middle_with_its_way_up(screen, robot, driving):
    map_ = screen.inset.map
    robot.publish("/pose", pose(3.0, 4.0, 0.5))
    driving.until(lambda: map_.located, "no pose")
    x, y = map_.view.to_screen(3.0, 4.0)
    assert (x, y) == pytest.approx(map_.center)
    assert map_.view.turn == pytest.approx(math.pi / 2 - 0.5)


def test_a_large_map_that_was_dragged_is_brought_back_by_a_button_and_by_the_next_swap(
    screen, robot, driving
):
    robot.publish("/pose", pose(3.0, 4.0, 0.5))
    driving.until(lambda: screen.inset.map.located, "no pose")
    swap(screen)
    inset = screen.inset
    assert inset.centre.right < 0
    inset.map.set_view(inset.map.view.moved(50, 0))
    inset.tick()
    assert screen.arranged["video"].holds(place(inset.centre))
    inset.centre.dispatch("on_release")
    inset.tick()
    assert inset.map.follow
    assert inset.centre.right < 0
    inset.map.set_view(inset.map.view.moved(50, 0))
    swap(screen)
    assert inset.map.follow


def test_what_is_said_over_the_small_one_takes_it_off_the_glass(screen):
    screen.clear(place(screen.inset.map))
    assert screen.inset.map.right < 0
    assert screen.inset.frame.right < 0
    screen.clear(None)
    assert screen.arranged["video"].holds(place(screen.inset.frame))


def test_a_robots_outline_is_on_its_map(screen, robot, driving):
    corners = [(2.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (2.0, -1.0)]
    robot.publish("/robot/info", RobotInfo(name="Fake-1", footprint=[Point32(x, y) for x, y in corners]))
    driving.until(lambda: driving.app.screens["drive"].inset.map.footprint == corners, "no outline")


@pytest.mark.parametrize("large", [False, True])
def test_the_map_draws_a_robot_that_may_be_at_two_places_as_unsure(screen, robot, driving, large: bool):
    if large:
        swap(screen)
    asked = PlaceCandidates(
        candidates=[PlaceCandidate(1, 0.0, 0.0, 0.0, 0.6, 0.1), PlaceCandidate(2, 4.0, 0.0, 0.0, 0.4, 0.1)]
    )
    robot.publish("/localisation/candidates", asked)
    driving.until(lambda: screen.inset.map.unsure, "it was drawn as sure")


def test_the_map_shows_the_points_that_the_operator_drew(screen, driving):
    driving.app.session.mission.add(4.0, 5.0)
    screen.tick()
    assert screen.inset.map.waypoints == [(4.0, 5.0)]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("crowded", [False, True])
@pytest.mark.parametrize("how", [arrange.drive, arrange.two_sticks])
def test_what_is_small_covers_nothing_that_is_touched_or_read(size, crowded, how):
    form, body = SIZES[size], Body(0, 0, *size, crowded)
    places = how(body, form, 1.0)
    small = inset_place(places, form, 1.0)
    assert small is not None, "every form has a map"
    assert body.holds(small)
    assert min(small.width, small.height) >= 66
    others = {
        name: one for name, one in places.items() if name not in ("video", "notice", "notice_low", "drawer")
    }
    if (how, form) == (arrange.two_sticks, "tall"):
        del others["senses_open"]  # unfolded it takes the small one off the glass
    assert not [name for name, one in others.items() if one.overlaps(small)]
    assert places["stop"].other is None or not places["stop"].other.overlaps(small)
    if form != "wide":
        assert not checks_beside(places, form, 1.0).overlaps(small)


def test_the_map_that_covers_the_robots_place_lies_beneath_the_small_one_too(screen, driving: Glass, robot):
    robot.publish("/robot/info", RobotInfo(latitude=45.5069, longitude=-73.579))
    driving.until(lambda: screen.inset.map.ground is not None, "nothing beneath the small map")
    reader = screen.inset.map.ground.source.reader
    driving.app.leave()
    assert reader._closed
