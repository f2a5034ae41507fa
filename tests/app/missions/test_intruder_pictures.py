"""The pictures of intruders that the robot keeps: on the card, in the list of events and beside the picture that one drives by."""

from __future__ import annotations

import io
from typing import Any

import pytest
from PIL import Image

from app.missions.intruder_pictures import NEWEST, SERVICE
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Event, Intruder, IntruderArray
from bridge.msgs.std_msgs import Header, Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass


def jpeg(wide: int = 60, high: int = 120) -> bytes:
    out = io.BytesIO()
    Image.new("RGB", (wide, high), (200, 40, 40)).save(out, "JPEG")
    return out.getvalue()


def found(glass: Glass, event: int = 41, intruder: int = 2) -> Event:
    return Event(
        id=event, boot="b", stamp=Time.at(glass.app.session.link.robot_time() - 1.0), level="alarm",
        kind="intruder", text=f"Intruder {intruder}: a person.", code="intruder_found",
        parameters=[KeyValue("id", str(intruder)), KeyValue("kind", "person")],
    )  # fmt: skip


@pytest.fixture
def watching(driving: Glass, robot: FakeRobot) -> Glass:
    driving.until(lambda: driving.app.session.link.robot_time() > 0, "no clock")
    return driving


def come(glass: Glass, robot: FakeRobot) -> None:
    """The robot, at (1, 2), tells of a person at (4, 6)."""
    now = glass.app.session.link.robot_time()
    here = PoseWithCovariance(pose=Pose(Point(1.0, 2.0), Quaternion.from_yaw(0.0)))
    robot.publish("/pose", PoseWithCovarianceStamped(Header(stamp=Time.at(now)), here))
    robot.happen(found(glass))
    one = Intruder(2, "person", Point(4.0, 6.0), Time.at(now - 1.0))
    robot.publish("/intruders", IntruderArray(intruders=[one]))


def asked(robot: FakeRobot) -> int:
    return sum(name == SERVICE for name, _ in robot.asked)


def test_the_card_shows_the_picture_that_the_robot_keeps(watching: Glass, robot: FakeRobot) -> None:
    robot.pictures[41] = jpeg()
    watching.app.show("mission")
    come(watching, robot)
    card: Any = watching.app.screens["mission"].intruder
    watching.until(lambda: card.texture is not None, "no picture")
    assert tuple(card.texture.size) == (60, 120)
    assert card.title == "Intruder 2 · person"
    picture = card.ids.picture
    assert tuple(picture.norm_image_size) == pytest.approx(tuple(picture.size), abs=1.0), "from head to foot"
    assert picture.width == pytest.approx(picture.height / 2, abs=1.0)


def test_the_list_of_events_shows_it_in_its_row_and_it_is_asked_for_once(
    watching: Glass, robot: FakeRobot
) -> None:
    robot.pictures[41] = jpeg()
    watching.app.show("mission")
    come(watching, robot)
    events = watching.app.screens["mission"].panel.events
    watching.until(lambda: ("b", 41) in events.pictures, "no picture")
    row = next(row for row in events.ids.view.data if row.get("texture"))
    assert row["text"].startswith("Intruder 2")
    watching.stage.run_for(0.5)
    assert asked(robot) == 1


def test_who_drives_sees_it_beside_the_badge(watching: Glass, robot: FakeRobot) -> None:
    robot.pictures[41] = jpeg()
    watching.app.show("drive")
    come(watching, robot)
    picture = watching.app.screens["drive"].sight.picture
    watching.until(lambda: picture.texture is not None, "no picture")
    assert picture.opacity == 1
    assert picture.width == pytest.approx(picture.height / 2, abs=1.0), "no gap beside who stands"


@pytest.mark.parametrize(
    "file", [b"", b"\xff\xd8\xff nonsense", jpeg(600, 600)], ids=["none", "broken", "large"]
)
def test_a_picture_that_is_none_is_not_shown_and_not_asked_for_again(
    watching: Glass, robot: FakeRobot, file: bytes
) -> None:
    robot.pictures[41] = file
    watching.app.show("mission")
    come(watching, robot)
    watching.until(lambda: asked(robot) == 1, "not asked")
    watching.stage.run_for(0.5)
    assert asked(robot) == 1
    assert watching.app.session.pictures.newest() == {}


def test_of_many_the_newest_are_fetched(watching: Glass, robot: FakeRobot) -> None:
    book, pictures = watching.app.session.logbook, watching.app.session.pictures
    for number in range(1, NEWEST + 4):
        book.add(found(watching, number, number))
    pictures.newest()
    watching.until(lambda: asked(robot) == NEWEST, "not asked")
    events = [request.event for name, request in robot.asked if name == SERVICE]
    assert len(set(events)) == NEWEST
