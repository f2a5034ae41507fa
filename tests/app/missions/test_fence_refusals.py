from __future__ import annotations

import pytest

from app.link.feeds import Feeds, Post
from app.missions.fence_refusals import FenceRefusals, summary
from app.missions.mission_editor import Draft
from bridge.msgs.geometry_msgs import Point32, Polygon
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
def refusals(feeds) -> FenceRefusals:
    return FenceRefusals(feeds)


def test_before_a_robot_tells_its_fence_nothing_is_refused():
    refusals = FenceRefusals(Feeds(lambda: 0.0))
    assert refusals.draft(Draft(points=((1e6, 0.0),), home=(0.0, 0.0))) == {}


def test_points_and_home_are_called_as_the_robot_calls_them(refusals):
    found = refusals.draft(Draft(points=((5.0, 5.0), (11.0, 5.0)), home=(9.5, 5.0)))
    assert found == {
        "Point 2": "Point 2 at (11.0, 5.0) is outside the robot's fence.",
        "Home": "Home at (9.5, 5.0) is 0.50 m from the robot's fence; the robot needs 0.65 m.",
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
    assert refusals.order(TaskOrder(task="patrol"), draft) == "The fence forbids point 2."
    assert refusals.order(TaskOrder(task="patrol", places=["Office"]), draft) == ""


def test_of_a_dock_only_the_robot_knows(refusals):
    assert refusals.place(Place(name="", x=12.0, y=5.0)).startswith("The place at (12.0, 5.0)")
    assert refusals.place(Place(name="Dock", kind="dock", x=12.0, y=5.0)) == ""


@pytest.mark.parametrize(
    ("names", "said"),
    [
        ([], ""),
        (["Home"], "The fence forbids home."),
        (["Point 3"], "The fence forbids point 3."),
        (["Point 3", "Point 11", "Home"], "The fence forbids points 3, 11 and home."),
        ([f"Point {n}" for n in range(1, 6)], "The fence forbids 5 points."),
    ],
)
def test_the_short_sentence_names_few_and_counts_many(names, said):
    assert summary(names) == said
