from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    zeros36,
)
from bridge.msgs.pilothouse_msgs import Limits
from widgets.core.quantities import quantities
from widgets.core.shapes import Shapes
from widgets.map import fence_marks
from widgets.map.fence import Fence
from widgets.map.grid_map import GridMap
from widgets.map.map_heights import between_words, height_words, pose_words


def told(z: float, variance: float = 0.01, x: float = 0.0) -> PoseWithCovarianceStamped:
    covariance = zeros36()
    covariance[14] = variance
    turned = Quaternion.from_rpy(0.4, -0.3, 0.7)
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, 0.0, z), turned), covariance))


@pytest.fixture
def feet():
    quantities.system = "imperial"
    yield
    quantities.system = "metric"


@pytest.fixture
def map_(stage):
    return stage.show(GridMap(robot_radius=0.2), size=(400, 300))


def plain(words: str) -> str:
    return words.replace("\u00a0", " ").replace("\u202f", " ")


def texts(map_, stage) -> list[str]:
    stage.frames(2)
    return [plain(text) for _, words in map_._layers for text in words.texts]


def test_a_height_is_up_and_a_depth_deep_and_the_ground_is_neither():
    assert plain(height_words(2.0)) == "2.0 m up"
    assert plain(height_words(-1.5)) == "1.5 m deep"
    for nothing in (0.0, 0.1, -0.1, math.nan, math.inf):
        assert height_words(nothing) == ""


def test_a_height_is_said_in_the_operators_unit(feet):
    assert plain(height_words(2.0)) == "7 ft up"


def test_a_height_that_is_not_known_is_not_said_and_one_of_a_flat_pose_neither():
    assert plain(pose_words(told(2.0))) == "2.0 m up"
    assert plain(pose_words(told(2.0, variance=0.0))) == "2.0 m up", (
        "another maker's robot that tells no variance"
    )
    assert pose_words(told(2.0, variance=1e4)) == ""
    assert pose_words(told(0.0)) == ""


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (2.5, 14.0, "Height 2.5 m to 14.0 m"),
        (-math.inf, 14.0, "Height up to 14.0 m"),
        (2.5, math.inf, "Height from 2.5 m"),
        (-6.0, -0.5, "Depth 0.5 m to 6.0 m"),
        (-6.0, math.inf, "Depth up to 6.0 m"),
        (-math.inf, -0.5, "Depth from 0.5 m"),
        (-math.inf, math.inf, ""),
    ],
)
def test_between_floor_and_ceiling_reads_as_people_go_there(low, high, words):
    assert plain(between_words(low, high)) == words


def test_the_robots_height_stands_beside_its_sign_and_goes_when_it_lands(map_, stage):
    map_.show(told(2.04))
    assert "2.0 m up" in texts(map_, stage)
    assert map_.robot[2] == pytest.approx(0.7), "a pose in space points where its nose does"
    map_.show(told(-1.5))
    assert "1.5 m deep" in texts(map_, stage)
    map_.show(told(0.02))
    assert not [text for text in texts(map_, stage) if " up" in text or "deep" in text]


def test_a_robot_that_hovers_in_place_does_not_draw_the_map_anew(map_, stage):
    map_.show(told(2.01))
    stage.frames(2)
    drawn = []
    map_.draw = lambda: drawn.append(1)
    for z in (2.02, 2.04, 1.98):
        map_.show(told(z))
        stage.frames(2)
    assert drawn == []


def test_points_have_their_heights_and_those_without_none(map_, stage):
    map_.waypoints, map_.heights = [(0.0, 0.0), (2.0, 0.0), (4.0, 0.0)], [3.0, None]
    shown = texts(map_, stage)
    assert shown.count("3.0 m up") == 1
    assert len([text for text in shown if " up" in text]) == 1


def test_the_legend_says_floor_and_ceiling_by_the_tightest_of_what_the_robot_tells():
    fence = Fence.of(Limits(floor=-8.0, ceiling=-0.5, max_depth=6.0, min_depth=1.0, max_height=15.0))
    assert (fence.floor, fence.ceiling) == (-6.0, -1.0)
    words = [plain(word.text) for word in fence_marks.legend(Shapes(), fence, 10, 10, 500)]
    assert words == ["Depth 1.0 m to 6.0 m"]
    assert fence_marks.legend_width(fence) > 50
    assert list(fence_marks.legend(Shapes(), Fence.of(Limits()), 10, 10, 500)) == []


def test_a_point_beyond_floor_or_ceiling_is_a_fault_with_a_sentence():
    fence = Fence(floor=1.0, ceiling=14.0)
    said = "Point 2 is not between floor and ceiling of the robot's fence."
    assert fence.height_fault("Point 2", 14.1) == fence.height_fault("Point 2", 0.9) == said
    for fits in (1.0, 14.0, math.nan):
        assert fence.height_fault("Point 2", fits) == ""
