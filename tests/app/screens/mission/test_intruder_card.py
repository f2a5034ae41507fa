"""An intruder on the mission screen: a card with its picture, how far and where it is, and what can be done about it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from app.link.camera_decoder import Picture
from app.screens.mission.intruder_card import cut_out
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Event, Intruder, IntruderArray
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.vision_msgs import (
    BoundingBox2D,
    Detection2D,
    Detection2DArray,
    ObjectHypothesis,
    ObjectHypothesisWithPose,
    Point2D,
    Pose2D,
)
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

EAST = PoseWithCovarianceStamped(
    pose=PoseWithCovariance(pose=Pose(Point(1.0, 2.0), Quaternion.from_yaw(0.0)))
)
"""The robot at (1, 2), turned to the east."""


def detection(
    x: float, y: float, width: float, height: float, ahead: float = 3.0, left: float = 4.0
) -> Detection2D:
    where = PoseWithCovariance(Pose(Point(ahead, left)))
    box = BoundingBox2D(Pose2D(Point2D(x, y)), width, height)
    return Detection2D(Header(), [ObjectHypothesisWithPose(ObjectHypothesis("cone", 0.9), where)], box)


def picture(stamp: float, wide: int = 64, high: int = 48, taken: tuple[int, int] = (0, 0)) -> Picture:
    """A black one with a red square of 8 pixels a side round its middle."""
    pixels = np.zeros((high, wide, 4), np.uint8)
    pixels[..., 3] = 255
    pixels[high // 2 - 4 : high // 2 + 4, wide // 2 - 4 : wide // 2 + 4, 0] = 255
    return Picture(1, stamp, wide, high, pixels.tobytes(), taken)


@pytest.fixture
def mission(driving: Glass, robot: FakeRobot) -> Any:
    driving.app.show("mission")
    screen = driving.app.screens["mission"]
    driving.until(lambda: driving.app.session.link.robot_time() > 0, "no clock")
    return screen


def find(glass: Glass, robot: FakeRobot, *ids: int, kind: str = "cone", ago: float = 1.0) -> None:
    """The robot tells that it knows these, which stand 3 m ahead of it and 4 m to its left."""
    stamp = Time.at(glass.app.session.link.robot_time() - ago)
    intruders = [Intruder(one, kind, Point(4.0, 6.0), stamp) for one in ids]
    robot.publish("/intruders", IntruderArray(intruders=intruders))


def test_a_new_intruder_is_a_card_with_class_distance_and_bearing(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    robot.publish("/pose", EAST)
    driving.until(lambda: mission.map.located, "no pose")
    find(driving, robot, 7)
    card = mission.intruder
    driving.until(lambda: card.parent is not None, "no card")
    assert card.title == "Intruder 7 · cone"
    driving.until(lambda: "5.0" in card.detail, card.detail)
    assert card.detail.replace("\u00a0", " ") == "5.0 m · bearing 037° · 53° left"
    assert card.texture is None
    assert not card.collide_widget(driving.app.shell.stop)


def test_what_was_found_long_ago_or_was_known_before_brings_no_card(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    find(driving, robot, 1, ago=600.0)
    driving.until(lambda: len(mission.map.intruders) == 1, "not told")
    assert mission.intruder.parent is None
    find(driving, robot, 1, ago=1.0)
    driving.stage.run_for(0.3)
    assert mission.intruder.parent is None


def test_one_of_no_known_class_is_called_so_and_without_a_pose_no_distance_is_said(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    find(driving, robot, 2, kind="unknown")
    driving.until(lambda: mission.intruder.parent is not None, "no card")
    assert mission.intruder.title == "Intruder 2 · unknown"
    assert mission.intruder.detail == "How far it is from the robot is not known."


def test_show_brings_it_into_the_middle_of_the_map(driving: Glass, robot: FakeRobot, mission: Any) -> None:
    find(driving, robot, 3)
    driving.until(lambda: mission.intruder.parent is not None, "no card")
    mission.map.centre_on(500.0, 500.0)
    driving.tap(mission.intruder.ids.show)
    x, y, wide, high = mission.map.free_box
    assert mission.map.view.to_screen(4.0, 6.0) == pytest.approx((x + wide / 2, y + high / 2))
    assert mission.intruder.parent is not None


def test_the_sides_from_which_it_was_not_seen_stay_on_its_card(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    find(driving, robot, 1, 2)
    card = mission.intruder
    driving.until(lambda: card.title == "Intruder 2 · cone, 1 more", card.title)
    for number, (intruder, sides) in enumerate((("2", "west"), ("2", "west, north-west"), ("1", "east")), 50):
        values = {"id": intruder, "sides": "4", "count": "6", "missing": sides}
        event = Event(
            id=number, boot="b", kind="intruder", text=f"Intruder {intruder}; not: {sides}.", code="intruder_circled",
            parameters=[KeyValue(key, value) for key, value in values.items()],
        )  # fmt: skip
        driving.app.session.logbook.add(event)
    driving.until(lambda: card.detail.endswith("\nIntruder 2; not: west, north-west."), card.detail)
    driving.tap(card.ids.seen)
    assert card.detail.endswith("\nIntruder 1; not: east.")


def test_seen_tells_the_robot_s_log_and_the_one_before_it_comes_up(
    driving: Glass, robot: FakeRobot, mission: Any
) -> None:
    find(driving, robot, 1)
    driving.until(lambda: mission.intruder.parent is not None, "no card")
    find(driving, robot, 1, 2)
    driving.until(lambda: mission.intruder.title == "Intruder 2 · cone, 1 more", mission.intruder.title)
    event = Event(
        id=41, boot="b", level="alarm", kind="intruder", text="Intruder 2: a cone.", code="intruder_found",
        parameters=[KeyValue("id", "2")],
    )  # fmt: skip
    asked: list[list[Event]] = []
    driving.app.session.logbook.acknowledge = asked.append
    driving.app.session.logbook.add(event)
    driving.tap(mission.intruder.ids.seen)
    assert [[one.id for one in events] for events in asked] == [[41]]
    assert mission.intruder.title == "Intruder 1 · cone"
    driving.tap(mission.intruder.ids.seen)
    assert mission.intruder.parent is None


def test_what_the_robot_forgot_needs_no_card(driving: Glass, robot: FakeRobot, mission: Any) -> None:
    find(driving, robot, 1)
    driving.until(lambda: mission.intruder.parent is not None, "no card")
    robot.publish("/intruders", IntruderArray())
    driving.until(lambda: mission.intruder.parent is None, "still there")


@pytest.mark.parametrize(
    ("ahead", "late", "has"), [(3.0, 0.2, True), (9.0, 0.2, False), (3.0, 5.0, False)],
    ids=["of it", "of something else", "of another time"],
)  # fmt: skip
def test_its_picture_is_cut_out_of_the_frame_in_which_it_was_found(
    driving: Glass, robot: FakeRobot, mission: Any, ahead: float, late: float, has: bool
) -> None:
    robot.publish("/pose", EAST)
    now = driving.app.session.link.robot_time()
    found = Detection2DArray(Header(stamp=Time.at(now)), [detection(32, 24, 8, 8, ahead=ahead)])
    robot.publish("/detections", found)
    driving.until(lambda: driving.app.session.feeds.latest("/detections"), "nothing detected")
    driving.until(lambda: mission.map.located, "no pose")
    mission.show_picture(picture(now + late), 15.0, 0.1)
    find(driving, robot, 1)
    driving.until(lambda: mission.intruder.parent is not None, "no card")
    assert (mission.intruder.texture is not None) == has


@pytest.mark.parametrize("taken", [(0, 0), (128, 96)], ids=["as taken", "made smaller on its way"])
def test_what_is_cut_out_has_the_thing_in_its_middle(taken: tuple[int, int]) -> None:
    scale = 2 if taken[0] else 1
    pixels = cut_out(picture(0.0, taken=taken), detection(32 * scale, 24 * scale, 8 * scale, 8 * scale))
    assert pixels is not None
    high, wide = pixels.shape[:2]
    assert (high, wide) == (17, 17)
    assert pixels[high // 2, wide // 2, 0] == 255
    assert pixels[0, 0, 0] == 0


@pytest.mark.parametrize(
    "box",
    [(-50.0, 24.0, 8.0, 8.0), (32.0, 500.0, 8.0, 8.0), (float("nan"), 24.0, 8.0, 8.0), (0.0, 0.0, 0.0, 0.0)],
)
def test_what_is_not_in_the_picture_is_cut_out_of_nothing(box: tuple[float, float, float, float]) -> None:
    assert cut_out(picture(0.0), detection(*box)) is None


def test_a_picture_that_lacks_pixels_gives_none() -> None:
    short = Picture(1, 0.0, 64, 48, b"\0" * 100)
    assert cut_out(short, detection(32, 24, 8, 8)) is None
