from __future__ import annotations

import math

import pytest

from app.link.feeds import Feeds, Post
from app.missions.mission_editor import Draft
from app.missions.refusals import Refusals, summary
from bridge.msgs.arrays import Int8Array
from bridge.msgs.geometry_msgs import (
    Point,
    Point32,
    Polygon,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
)
from bridge.msgs.nav_msgs import MapMetaData, OccupancyGrid
from bridge.msgs.pilothouse_msgs import Limits, Place, PlaceArray, RobotInfo, TaskOrder

OUT = "Lab at (12.0, 5.0) is outside the robot's fence."


def square(size: float) -> Limits:
    return Limits(keep_in=[Polygon([Point32(0, 0), Point32(size, 0), Point32(size, size), Point32(0, size)])])


@pytest.fixture
def feeds() -> Feeds:
    feeds = Feeds(lambda: 0.0)
    feeds.put("/limits", Post(square(10.0), 0.0, 1))
    feeds.put("/robot/info", Post(RobotInfo(radius=0.25), 0.0, 1))
    places = [Place(name="Lab", x=12.0, y=5.0), Place(name="Office", x=5.0, y=5.0)]
    feeds.put("/places", Post(PlaceArray(places=places), 0.0, 1))
    return feeds


@pytest.fixture
def refusals(feeds) -> Refusals:
    return Refusals(feeds)


def test_before_a_robot_tells_its_fence_nothing_is_refused():
    refusals = Refusals(Feeds(lambda: 0.0))
    assert refusals.draft(Draft(points=((1e6, 0.0),), home=(0.0, 0.0))) == {}


def test_points_and_home_are_called_as_the_robot_calls_them(refusals):
    found = refusals.draft(Draft(points=((5.0, 5.0), (11.0, 5.0)), home=(9.5, 5.0)))
    assert found == {
        "Point 2": "Point 2 at (11.0, 5.0) is outside the robot's fence.",
        "Home": "Home at (9.5, 5.0) is 0.50\u00a0m from the robot's fence; the robot needs 0.65\u00a0m.",
    }


def test_another_fence_is_taken_at_once(feeds, refusals):
    draft = Draft(points=((11.0, 5.0),))
    assert refusals.draft(draft)
    feeds.put("/limits", Post(square(20.0), 1.0, 1))
    assert not refusals.draft(draft)


def test_an_order_is_judged_by_its_places(refusals):
    draft = Draft(points=((5.0, 5.0), (11.0, 5.0)))
    assert refusals.order(TaskOrder(task="deliver", places=["Office", "Lab"]), draft) == OUT
    assert refusals.order(TaskOrder(task="go_to", places=["Office"]), draft) == ""
    assert refusals.order(TaskOrder(task="go_to", places=["nowhere"]), draft) == ""
    assert (
        refusals.order(TaskOrder(task="patrol"), draft)
        == "Point 2 at (11.0, 5.0) is outside the robot's fence."
    )
    assert refusals.order(TaskOrder(task="patrol", places=["Office"]), draft) == ""


def test_of_a_dock_only_the_robot_knows(refusals):
    assert refusals.place(Place(name="", x=12.0, y=5.0)).startswith("The place at (12.0, 5.0)")
    assert refusals.place(Place(name="Dock", kind="dock", x=12.0, y=5.0)) == ""


@pytest.mark.parametrize(
    ("sentences", "said"),
    [
        ([], ""),
        (["Home is off the map."], "Home is off the map."),
        (["Point 3 is off.", "Home is off."], "Point 3 is off. 1 more would be refused too."),
        ([f"Point {n} is off." for n in range(1, 6)], "Point 1 is off. 4 more would be refused too."),
    ],
)
def test_the_whole_reason_of_the_first_is_said_and_the_others_are_counted(sentences, said):
    assert summary(sentences) == said


WALLED = OccupancyGrid(
    info=MapMetaData(resolution=1.0, width=10, height=10, origin=Pose(Point())),
    data=Int8Array(bytes(100 if column == 4 else 0 for _ in range(10) for column in range(10))),
)
"""10 m by 10 m with a wall from side to side."""


def test_the_map_is_judged_by_after_the_fence(feeds, refusals):
    feeds.put("/map", Post(WALLED, 0.0, 1))
    draft = Draft(points=((4.5, 5.0), (9.9, 5.0)))
    found = refusals.faults(draft)
    assert found["Point 1"].sentence == "Point 1 at (4.5, 5.0) is in a wall or another obstacle."
    assert found["Point 1"].brief == "in a wall"
    assert found["Point 2"].brief == "near the fence"
    assert refusals.place(Place(name="Lab", x=4.5, y=5.0)).startswith("Lab at (4.5, 5.0) is in a wall")


def test_ways_are_judged_only_from_where_the_robot_is(feeds, refusals):
    feeds.put("/map", Post(WALLED, 0.0, 1))
    draft = Draft(points=((7.5, 5.0),))
    assert refusals.draft(draft) == {}
    place = PoseWithCovariance(pose=Pose(Point(1.5, 5.0)))
    feeds.put("/pose", Post(PoseWithCovarianceStamped(pose=place), 0.0, 1))
    feeds.link(True)
    assert refusals.draft(draft) == {"Point 1": "There is no way to Point 1 at (7.5, 5.0)."}
    feeds.link(False)
    assert refusals.draft(draft) == {}


def test_another_map_is_taken_at_once(feeds, refusals):
    feeds.put("/map", Post(WALLED, 0.0, 1))
    draft = Draft(points=((4.5, 5.0),))
    assert refusals.draft(draft)
    free = OccupancyGrid(info=WALLED.info, data=Int8Array(bytes(100)))
    feeds.put("/map", Post(free, 1.0, 1))
    assert not refusals.draft(draft)


def test_the_clearance_of_the_robots_limits_counts_at_once():
    feeds = Feeds(lambda: 0.0)
    refusals = Refusals(feeds)
    feeds.put("/map", Post(WALLED, 0.0, 1))
    feeds.put("/robot/info", Post(RobotInfo(radius=0.25), 0.0, 1))
    draft = Draft(points=((5.5, 5.0),))  # 0.5 m from the wall
    for number, (clearance, refused) in enumerate([(math.nan, 0), (0.3, 1), (0.1, 0)]):
        feeds.put("/limits", Post(Limits(clearance=clearance), float(number), number))
        assert len(refusals.draft(draft)) == refused


def test_what_steers_like_a_car_is_judged_by_its_width():
    feeds = Feeds(lambda: 0.0)
    refusals = Refusals(feeds)
    feeds.put("/map", Post(WALLED, 0.0, 1))
    draft = Draft(points=((2.5, 5.0),))
    outline = [Point32(x, y) for x, y in ((-1.4, -0.55), (1.4, -0.55), (1.4, 0.55), (-1.4, 0.55))]
    for min_radius, sentences in ((4.0, 0), (0.0, 1)):
        feeds.put(
            "/robot/info", Post(RobotInfo(radius=1.6, footprint=outline, min_radius=min_radius), 0.0, 1)
        )
        assert len(refusals.draft(draft)) == sentences


def test_a_point_beyond_floor_or_ceiling_is_said_with_what_is_allowed(feeds, refusals):
    feeds.put("/limits", Post(Limits(floor=1.0, ceiling=14.0), 0.0, 2))
    draft = Draft(points=((5.0, 5.0), (6.0, 5.0), (7.0, 5.0)), heights=(20.0, None, 3.0))
    found = refusals.faults(draft)
    assert list(found) == ["Point 1"]
    assert found["Point 1"].sentence == "Point 1 is not between floor and ceiling of the robot's fence."
    assert found["Point 1"].brief.replace("\u00a0", " ") == "Height 1.0 m to 14.0 m"
