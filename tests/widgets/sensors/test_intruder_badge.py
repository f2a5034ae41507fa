from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray
from bridge.msgs.std_msgs import Header, Time
from widgets.sensors.intruder_badge import FRESH_DURATION, IntruderBadge


@pytest.fixture
def badge(stage):
    return stage.show(IntruderBadge(state="live"), size=(320, 46))


def pose(now: float, x: float = 0.0, y: float = 0.0, yaw: float = 0.0) -> PoseWithCovarianceStamped:
    here = Pose(Point(x, y), Quaternion.from_yaw(yaw))
    return PoseWithCovarianceStamped(Header(Time.at(now)), PoseWithCovariance(here))


def found(*seen: tuple[float, float, float]) -> IntruderArray:
    """Intruders at x, y, first seen then."""
    return IntruderArray(
        intruders=[Intruder(n, "cone", Point(x, y), Time.at(when)) for n, (x, y, when) in enumerate(seen, 1)]
    )


def test_the_last_one_is_told_with_distance_side_and_age(stage, badge):
    badge.show(found((9.0, 9.0, 80.0), (0.0, 4.0, 100.0)))
    badge.show_pose(pose(112.0))
    stage.frames(2)
    assert badge.texts == ["2 intruders", "last: 4.0 m · 90° left · 12 s ago"]
    assert badge.number == 2


def test_it_follows_the_robot(stage, badge):
    badge.show(found((4.0, 0.0, 100.0)))
    badge.show_pose(pose(101.0))
    badge.show_pose(pose(105.0, x=2.0, y=2.0, yaw=math.pi))
    stage.frames(2)
    assert badge.texts == ["1 intruder", "last: 2.8 m · 135° left · 5 s ago"]


def test_that_there_is_none_is_said_quietly(stage, badge):
    badge.show(found())
    stage.frames(2)
    assert badge.texts[1:] == ["No intruders"]
    assert not badge.fresh


def test_it_does_not_say_none_beside_one_that_is_marked_in_the_picture(stage, badge):
    badge.show(found())
    badge.seen = ["cone", "unknown", "cone"]
    stage.frames(2)
    assert badge.texts[1:] == ["Seen, not yet an intruder: 2 × cone, unknown"]
    badge.width = 800
    stage.frames(2)
    why = "it counts when seen three times in one place"
    assert badge.texts[1:] == [f"Seen, not yet an intruder: 2 × cone, unknown · {why}"]
    badge.show(found((4.0, 0.0, 100.0)))
    stage.frames(2)
    assert badge.texts[1] == "1 intruder"


def test_of_what_is_marked_a_narrow_badge_tells_the_things_and_one_without_room_shows_no_box(stage, badge):
    badge.show(found())
    badge.seen = ["cone"]
    badge.width = 108
    stage.frames(2)
    assert badge.texts[1:] == ["cone"]
    badge.width = 42
    stage.frames(2)
    assert badge.texts == []


def test_a_robot_that_does_not_know_where_it_is_tells_the_count_alone(stage, badge):
    badge.show(found((4.0, 0.0, 100.0)))
    stage.frames(2)
    assert badge.texts[1:] == ["1 intruder", "distance unknown"]
    assert badge.fresh


def test_news_grows_old(badge):
    badge.show(found((4.0, 0.0, 100.0)))
    badge.show_pose(pose(100.0 + FRESH_DURATION - 1))
    assert badge.fresh
    badge.show_pose(pose(100.0 + FRESH_DURATION + 1))
    assert not badge.fresh


@pytest.mark.parametrize(
    ("width", "second"), [(200, "4.0 m · 12 s"), (110, "4.0 m"), (228, "4.0 m · 90° left · 12 s ago")]
)
def test_a_narrow_badge_leaves_out_what_says_least(stage, width, second):
    badge = stage.show(IntruderBadge(state="live"), size=(width, 46))
    badge.show(found((0.0, 4.0, 100.0)))
    badge.show_pose(pose(112.0))
    stage.frames(2)
    assert badge.texts == ["1 intruder", second]


def test_a_pose_that_changes_nothing_that_is_read_is_not_drawn_anew(stage, badge):
    badge.show(found((4.0, 0.0, 100.0)))
    badge.show_pose(pose(101.0))
    stage.frames(2)
    changed = []
    badge.bind(
        away=lambda *_: changed.append(1),
        angle=lambda *_: changed.append(1),
        ago=lambda *_: changed.append(1),
    )
    badge.show_pose(pose(101.05, x=0.01))
    assert not changed


def test_what_is_old_is_no_news_and_says_how_old_it_is(stage, badge):
    badge.show(found((0.0, 4.0, 100.0)))
    badge.show_pose(pose(100.0))
    badge.state, badge.age = "stale", 8.2
    stage.frames(2)
    assert badge.texts == ["1 intruder", "last: 4.0 m · 90° left · 8 s old"]
    assert not badge.fresh
    badge.show(found())
    stage.frames(2)
    assert badge.texts[1:] == ["No intruders · 8 s old"]


@pytest.mark.parametrize("number", [math.nan, math.inf, 1e308])
def test_an_intruder_or_a_robot_that_is_nowhere_has_no_distance(stage, badge, number):
    badge.show(found((number, 0.0, 100.0)))
    badge.show_pose(pose(112.0))
    stage.frames(2)
    badge.show(found((2.0, 0.0, 100.0)))
    badge.show_pose(pose(112.0, x=number, yaw=0.0))
    stage.frames(2)
    assert not math.isfinite(badge.angle) or number == 1e308
    badge.show_pose(pose(112.0))
    assert badge.away == 2.0
