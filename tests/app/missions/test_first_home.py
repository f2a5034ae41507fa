"""Home at the start: the first place that the robot is sure of, and never in the place of another one."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from app.link.feeds import Feeds, Post
from app.missions.first_home import first_home
from app.missions.mission_editor import MissionEditor
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Check, Checklist, Mission, Place, PlaceArray, Waypoint


def pose(x: float, y: float) -> PoseWithCovarianceStamped:
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose(Point(x, y))))


def sure(state: str = "ok") -> Checklist:
    return Checklist(checks=[Check("battery", "ok", ""), Check("position", state, "")])


class Start:
    """A robot that was met just now, which has no home and is sure of where it is."""

    def __init__(self) -> None:
        self.feeds, self.mission = Feeds(lambda: 0.0), MissionEditor()
        self.feeds.link(True)
        self.put("/places", PlaceArray())
        self.put("/checklist", sure())
        self.put("/pose", pose(2.0, 3.0))
        self.mission.robot_has(Mission())

    def put(self, topic: str, msg: object) -> None:
        self.feeds.put(topic, Post(msg, 0.0, 1))

    @property
    def home(self) -> tuple[float, float] | None:
        return first_home(self.feeds, self.mission)


def test_the_first_place_that_it_is_sure_of_becomes_home_which_can_be_undone() -> None:
    start = Start()
    assert start.home == (2.0, 3.0)
    start.mission.set_home(*start.home)
    assert start.home is None, "once"
    start.mission.undo()
    assert start.mission.draft.home is None


@pytest.mark.parametrize(
    "but",
    [
        lambda start: start.put("/checklist", sure("unknown")),
        lambda start: start.put("/checklist", Checklist()),
        lambda start: start.put("/pose", pose(math.nan, 0.0)),
        lambda start: start.feeds.link(False),
        lambda start: start.mission.robot_has(Mission(home=[Waypoint(9.0, 9.0)])),
        lambda start: start.put("/places", PlaceArray(places=[Place(id=1, name="Base", kind="home")])),
        lambda start: start.mission.add(1.0, 1.0),
        lambda start: start.mission.sending(),
        lambda start: start.mission.set_home(5.0, 5.0),
    ],
    ids=[
        "it is not sure", "nobody says whether it is", "no numbers", "no link", "it has one", "a place is one",
        "points are drawn", "something is under way", "one is drawn",
    ],
)  # fmt: skip
def test_it_gets_none_where(but: Callable[[Start], object]) -> None:
    start = Start()
    but(start)
    assert start.home is None


def test_before_the_robot_has_told_what_it_has_none_is_set() -> None:
    start = Start()
    start.mission = MissionEditor()
    assert start.home is None
    start.mission.robot_has(Mission())
    start.feeds.forget()
    assert start.home is None
