"""The small sensors and what was found, on the drive screen of a robot that has them and of one that has not."""

from __future__ import annotations

import math
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest

from app.layout.arrange import Rect
from app.layout.layout import load
from app.link.feeds import Feeds, Post
from app.screens.drive.instruments import Instruments
from app.screens.drive.small_sensors import SmallSensors
from app.session.dashboard import Dashboard
from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array, Float64Array
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Intruder, IntruderArray, LineSensor, RobotInfo, SonarRing
from bridge.msgs.sensor_msgs import JointState, Range
from bridge.msgs.std_msgs import Header, Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets import CATALOGUE, EncodersView, LineSensorView, UltrasoundView

STRIP, ROOM = Rect(10, 400, 380, 54), Rect(10, 200, 380, 190)
SIDES = ("/range/front", "/range/left")


class Held:
    """A card with its three sensors, and feeds whose clock the test owns."""

    def __init__(self, stage: Any) -> None:
        self.now = 100.0
        self.feeds = Feeds(lambda: self.now)
        self.feeds.link(True)
        self.card = SmallSensors(self.feeds)
        self.ultrasound, self.line, self.encoders = UltrasoundView(), LineSensorView(), EncodersView()
        self.made: list[Any] = []
        for gauge, topics in (
            (self.ultrasound, SIDES),
            (self.line, ("/line_sensor",)),
            (self.encoders, ("/joint_states",)),
        ):
            self.card.add(partial(self.make, gauge), topics)
        stage.window.add_widget(self.card)
        self.card.place(STRIP, ROOM)
        self.stage = stage

    def make(self, gauge: Any) -> Any:
        self.made.append(gauge)
        return gauge

    def hear(self, topic: str, message: Msg) -> None:
        self.feeds.put(topic, Post(message, self.now, 1))
        self.card.tick()
        self.stage.frames(2)

    def hear_all(self) -> None:
        self.hear("/range/front", Range(range=1.0))
        self.hear("/line_sensor", LineSensor(values=Float32Array([0.1, 0.8])))
        self.hear("/joint_states", JointState(name=["wheel_left_joint"], velocity=Float64Array([1.0])))


@pytest.fixture
def held(stage: Any) -> Held:
    return Held(stage)


def test_of_a_robot_without_small_sensors_nothing_is_on_the_glass(held: Held) -> None:
    held.card.tick()
    assert held.card.opacity == 0
    assert held.card.size == [0, 0]
    assert held.card.children == []


def test_only_what_the_robot_has_told_of_has_a_place(held: Held) -> None:
    held.hear("/line_sensor", LineSensor())
    assert held.card.shown == (held.line,)
    assert held.encoders.parent is None
    held.hear_all()
    assert held.card.shown == (held.ultrasound, held.line, held.encoders)


def test_a_sensor_is_made_once_and_not_before_the_robot_tells_something_of_it(held: Held) -> None:
    held.card.tick()
    assert held.made == []
    held.hear("/line_sensor", LineSensor())
    held.hear("/range/left", Range(range=2.0))
    held.hear("/range/front", Range(range=1.0))
    assert held.made == [held.line, held.ultrasound]
    assert held.card.shown == (held.ultrasound, held.line)
    assert [gauge.card for gauge in held.card.shown] == [False, False]


def test_a_sensor_that_cannot_be_made_is_left_out_and_the_others_are_shown(
    held: Held, caplog: pytest.LogCaptureFixture
) -> None:
    tries: list[str] = []

    def broken() -> Any:
        tries.append("made")
        raise ImportError("no module of that name")

    held.card.add(broken, ("/sonar",))
    held.card.add(partial(held.make, late := UltrasoundView()), ("/range/rear",))
    held.hear("/sonar", SonarRing())
    held.hear("/range/rear", Range(range=1.0))
    held.hear_all()
    assert tries == ["made"], "it is not tried in every tick"
    assert held.card.shown == (held.ultrasound, held.line, held.encoders, late)
    assert [
        record.getMessage() for record in caplog.records if record.name == "app.screens.drive.small_sensors"
    ] == ["The sensor of /sonar cannot be shown"]


def test_a_tap_unfolds_the_strip_and_another_folds_it(held: Held) -> None:
    held.hear_all()
    assert tuple(held.card.size) == (STRIP.width, STRIP.height)
    assert held.line.low
    held.stage.tap(200, 420)
    assert tuple(held.card.size) == (ROOM.width, ROOM.height)
    assert not held.line.low
    held.stage.tap(200, 300)
    assert held.card.folded


def test_a_finger_that_slides_off_the_strip_does_not_unfold_it(held: Held) -> None:
    held.hear_all()
    held.stage.drag([(200, 420), (200, 100)])
    assert held.card.folded


@pytest.mark.parametrize("unfolded", [False, True])
def test_the_sensors_lie_on_the_card_and_not_on_each_other(held: Held, unfolded: bool) -> None:
    held.hear_all()
    held.card.open = unfolded
    room = ROOM if unfolded else STRIP
    places = [Rect(*one.pos, *one.size) for one in held.card.children]
    assert len(places) == 4, "three sensors and the sign"
    for number, place in enumerate(places):
        assert room.holds(place)
        assert not any(place.overlaps(other) for other in places[number + 1 :])


def test_a_strip_that_is_too_narrow_shows_the_first_sensors_only(held: Held) -> None:
    held.hear_all()
    held.card.place(Rect(10, 400, 130, 54), ROOM)
    assert held.line.parent is None
    assert held.ultrasound.parent is held.card
    held.card.open = True
    assert held.line.parent is held.card


def test_where_there_is_room_it_is_always_open_and_a_tap_changes_nothing(held: Held) -> None:
    held.card.place(ROOM, ROOM)
    held.hear_all()
    held.stage.tap(200, 300)
    assert not held.card.foldable
    assert not held.card.open
    assert len(held.card.children) == 3


def test_one_ranger_that_still_speaks_keeps_the_picture_live_and_none_makes_it_old(held: Held) -> None:
    for topic in SIDES:
        held.hear(topic, Range(range=1.0))
    held.now += 5.0
    held.hear(SIDES[1], Range(range=1.0))
    assert held.ultrasound.state == "live"
    held.now += 5.0
    held.card.tick()
    assert (held.ultrasound.state, held.ultrasound.age) == ("stale", 5.0)


def test_what_is_as_old_as_the_rest_does_not_say_so_again(held: Held) -> None:
    held.hear_all()
    held.now += 5.0
    held.card.tick()
    assert [one.badge for one in held.card.shown] == ["5 s old", "", ""]
    held.hear("/line_sensor", LineSensor())
    held.now += 4.0
    held.card.tick()
    assert [one.badge for one in held.card.shown] == ["9 s old", "4 s old", "9 s old"]


def test_the_drive_screen_shows_the_readings_and_marks_the_intruder_in_the_picture(
    driving: Glass, robot: FakeRobot
) -> None:
    screen = driving.app.screens["drive"]
    assert screen.senses.opacity == 0
    assert screen.sight.opacity == 0
    robot.publish("/robot/info", RobotInfo(name="Fake-1", kind="wheels", max_speed=0.8, camera_fov=1.2))
    for side, away in (("front", 0.4), ("left", math.inf)):
        message = Range(Header(Time.at(5.0), f"ultrasound_{side}"), max_range=4.0, range=away)
        robot.publish(f"/range/{side}", message)
    robot.publish("/line_sensor", LineSensor(values=Float32Array([0.1, 0.8, 0.1]), spacing=0.02))
    found = Intruder(2, "cone", Point(3.0, 3.0), Time.at(90.0))
    robot.publish("/intruders", IntruderArray(intruders=[found]))
    driving.until(lambda: len(screen.senses.shown) == 2, "no readings")
    driving.until(lambda: screen.senses.shown[0].nearest == "ultrasound_front", "no echo")
    driving.until(lambda: len(screen.senses.shown[0].echoes) == 2, "one echo")
    assert screen.senses.shown[0].echoes["ultrasound_left"].range == math.inf
    here = PoseWithCovarianceStamped(Header(Time.at(100.0)), PoseWithCovariance(Pose()))
    # a pose that is not told again is soon an old one, and what lies by an old one is not marked
    driving.until(lambda: robot.publish("/pose", here) or screen.video.marks, "no mark")
    assert screen.video.marks == [("2 · 4.2 m", pytest.approx(math.pi / 4))]
    assert pytest.approx(math.pi / 4) in list(screen.video.counted), "a box there is that of an intruder"
    assert screen.video.field_of_view == pytest.approx(1.2)
    assert (screen.sight.opacity, screen.sight.count, screen.sight.ago) == (1, 1, 10)
    robot.publish("/pose", here)
    driving.until(lambda: screen.sight.state == "live", "old")
    robot.stop()
    driving.until(lambda: screen.sight.state == "stale" and screen.sight.age >= 1.0, "not old without a link")
    assert screen.sight.texts[-1].endswith(" s old")


def test_what_the_unfolded_sensors_cover_is_not_seen_until_they_fold(
    driving: Glass, robot: FakeRobot
) -> None:
    screen = driving.app.screens["drive"]
    robot.publish("/line_sensor", LineSensor(values=Float32Array([0.1])))
    driving.until(lambda: screen.senses.shown, "no line sensor")
    screen.arrange(Rect(0, 60, 412, 776), "tall", 1.0)
    laser = screen.places["top_left"][0]
    screen.senses.open = True
    assert laser.opacity == 0
    assert screen.video.opacity == screen.stick.opacity == 1
    screen.senses.open = False
    assert laser.opacity == 1


def test_a_sensor_that_is_made_late_says_where_what_it_shows_comes_from(stage: Any) -> None:
    feeds = Feeds(lambda: 0.0)
    instruments = Instruments(load("patrol", CATALOGUE), Dashboard(feeds), feeds)
    offer: Any = SimpleNamespace(source=lambda _: "/ring_of_sonars", pose_by_odometry=False)
    instruments.name_sources(offer)
    make = next(make for make, topics in instruments.senses if "/sonar" in topics)
    title = make().title
    assert title == "Sonar · …ing_of_sonars"
