"""A robot behind somebody else's server, with a line that the test holds in its hand."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable

import pytest

from bridge.core.topics import CAMERA
from bridge.msgs import Msg
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import Event, RobotInfo
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.msgs.std_msgs import Header, Time
from robotside.foreign.foreign_link import Listener
from robotside.foreign.foreign_robot import (
    JPEG_START,
    REPEAT_PERIOD,
    REST_REPEATS,
    SILENT_SENTENCE,
    ForeignRobot,
)
from robotside.foreign.foreign_topics import Found

URL = "ws://robot:9090"
SPEED, REST = Twist.planar(0.3, 0.0), Twist()


class Line:
    """Records what is sent; tells what the test has it tell."""

    def __init__(self, meet: Callable[[Listener], None]) -> None:
        self._meet = meet
        self.sent: list[Twist] = []
        self.wanted: list[tuple[str, bool]] = []
        self.clock = math.nan
        self.silent = self.dropped = False
        self.closed = False

    def __call__(self, url: str, listener: Listener) -> Line:
        self._meet(listener)
        return self

    def robot_time(self) -> float:
        return self.clock

    def drive(self, twist: Twist) -> None:
        self.sent.append(twist)

    def press_stop(self) -> None:
        pass

    def release_stop(self) -> None:
        pass

    def want(self, topic: str, wanted: bool) -> None:
        self.wanted.append((topic, wanted))

    def close(self) -> None:
        self.closed = True


def found(*topics: str, remarks: tuple[str, ...] = ()) -> Found:
    return Found({topic: (topic, Odometry) for topic in topics}, remarks=remarks)


def here(*topics: str, remarks: tuple[str, ...] = ()) -> tuple[ForeignRobot, Line]:
    line = Line(lambda listener: listener.on_found(found(*topics, remarks=remarks)))
    robot = ForeignRobot(URL, patience=0.0, connect=line)
    for number in range(REST_REPEATS + 2):
        robot.read(number * REPEAT_PERIOD)
    line.sent.clear()
    return robot, line


def nobody(listener: Listener) -> None:
    listener.on_lost("No robot answers at robot:9090 (connection refused).")


def test_with_nobody_there_it_says_so_and_commands_go_nowhere() -> None:
    line = Line(nobody)
    robot = ForeignRobot(URL, connect=line)
    assert (
        robot.trouble == "The robot cannot be reached: no robot answers at robot:9090 (connection refused)."
    )
    robot.drive(SPEED)
    assert line.sent == []
    assert (robot.info.name, robot.info.max_speed, robot.info.cameras) == (
        "Robot at robot:9090",
        0.5,
        ["front"],
    )
    assert robot.info.description == "ROS robot"


def test_before_anybody_answered_there_is_trouble_too() -> None:
    robot = ForeignRobot(URL, patience=0.0, connect=Line(lambda _: None))
    assert robot.trouble == "The robot cannot be reached: no answer yet from robot:9090."


def test_the_start_waits_for_the_robot_and_for_what_it_sends_once() -> None:
    told = RobotInfo(
        "Rex", "wheels", "patrol", "Differential drive", "hall", 0.7, 1.9, 0.18, ["mast", "rear"]
    )
    threads: list[threading.Thread] = []

    def meet(listener: Listener) -> None:
        def later() -> None:
            listener.on_found(found("/robot/info", "/map", CAMERA))
            listener.on_message("/robot/info", told)
            listener.on_message("/map", OccupancyGrid())

        threads.append(threading.Timer(0.05, later))
        threads[0].start()

    robot = ForeignRobot(URL, connect=Line(meet))
    assert (robot.info.name, robot.info.max_speed, robot.info.radius) == ("Rex", 0.7, 0.18)
    assert (robot.info.description, robot.info.cameras) == ("Differential drive", ["mast"])
    assert [topic for topic, _ in robot.read(0.0)] == ["/map"]
    threads[0].join()


def test_a_robot_without_camera_offers_none() -> None:
    robot, _ = here("/odom")
    assert robot.info.cameras == []


def test_what_is_missing_is_told_once_even_when_the_link_comes_back() -> None:
    line = Line(lambda listener: listener.on_found(found(remarks=("There is no laser.",))))
    robot = ForeignRobot(URL, patience=0.0, connect=line)
    remark = Event(level="warn", kind="robot", text="There is no laser.", code="foreign_remark")
    assert robot.read(0.0) == [("/events", remark)]
    robot.on_lost("The connection was cut.")
    robot.on_found(found(remarks=("There is no laser.",)))
    assert robot.read(1.0) == []


def test_a_command_is_repeated_until_the_next_one() -> None:
    robot, line = here()
    robot.drive(SPEED)
    for number in range(61):
        robot.read(10.0 + number / 60)
    assert line.sent.count(SPEED) == pytest.approx(10, abs=1)
    robot.drive(REST)
    assert line.sent[-1] == REST


def test_rest_is_said_several_times_and_then_no_more() -> None:
    robot, line = here()
    robot.drive(SPEED)
    robot.stop()
    for number in range(600):
        robot.read(10.0 + number / 60)
    assert line.sent == [SPEED, *[REST] * (REST_REPEATS + 1)]


def test_a_rest_that_did_not_leave_is_not_counted() -> None:
    robot, line = here()
    robot.drive(SPEED)
    robot.stop()
    line.dropped = True
    for number in range(300):
        robot.read(10.0 + number / 60)
    line.dropped = False
    line.sent.clear()
    for number in range(600):
        robot.read(15.0 + number / 60)
    assert line.sent == [REST] * REST_REPEATS


def test_while_the_line_is_lost_nothing_is_said() -> None:
    robot, line = here()
    robot.drive(SPEED)
    robot.on_lost("The connection was cut.")
    line.sent.clear()
    for number in range(60):
        robot.read(20.0 + number / 60)
    assert line.sent == []


def test_after_an_outage_rest_is_said_and_the_command_before_it_is_forgotten() -> None:
    robot, line = here()
    robot.drive(SPEED)
    robot.on_lost("The connection was cut.")
    line.sent.clear()
    robot.read(20.0)
    robot.drive(SPEED)
    assert line.sent == []
    robot.on_found(found())
    assert robot.trouble == ""
    for number in range(600):
        robot.read(30.0 + number / 60)
    assert set(line.sent) == {REST}


def test_of_each_topic_the_newest_is_read_in_the_order_of_arrival() -> None:
    robot, _ = here("/odom", "/scan")
    for speed in (1.0, 2.0):
        robot.on_message("/odom", Odometry(child_frame_id=str(speed)))
        robot.on_message("/scan", LaserScan(range_max=speed))
    read = robot.read(50.0)
    assert [topic for topic, _ in read] == ["/odom", "/scan"]
    assert isinstance(read[1][1], LaserScan)
    assert read[1][1].range_max == 2.0
    assert robot.read(50.1) == []


def test_what_came_before_the_link_was_lost_is_not_read_after_it() -> None:
    robot, _ = here("/odom")
    robot.on_message("/odom", Odometry())
    robot.on_message("/map", OccupancyGrid())
    robot.on_lost("The connection was cut.")
    assert [topic for topic, _ in robot.read(50.0)] == ["/map"]


def stamp_of(robot: ForeignRobot, msg: Msg, now: float) -> float:
    robot.on_message("/scan", msg)
    ((_, read),) = robot.read(now)
    return float(read.header.stamp.seconds)  # type: ignore[attr-defined]


def scan(stamp: float) -> LaserScan:
    return LaserScan(Header(Time.at(stamp), "laser"))


def test_a_stamp_is_told_by_our_clock() -> None:
    robot, line = here("/scan")
    line.clock = 5000.0
    assert stamp_of(robot, scan(4999.8), 100.0) == pytest.approx(99.8)


@pytest.mark.parametrize("stamp", [0.0, 12.0, 5001.0])
def test_a_stamp_of_no_known_clock_becomes_the_moment_of_arrival(stamp: float) -> None:
    robot, line = here("/scan")
    line.clock = 5000.0
    assert stamp_of(robot, scan(stamp), 100.0) == 100.0


def test_a_robot_that_does_not_tell_the_time_has_its_messages_stamped_on_arrival() -> None:
    robot, _ = here("/scan")
    assert stamp_of(robot, scan(99.5), 100.0) == 100.0


def test_stamps_of_a_topic_never_go_back() -> None:
    robot, line = here("/scan")
    line.clock = 5000.0
    assert stamp_of(robot, scan(4999.99), 100.0) == pytest.approx(99.99)
    line.clock = 5000.3
    assert stamp_of(robot, scan(5000.0), 100.05) == pytest.approx(99.99)


def test_the_camera_is_asked_for_on_demand_and_the_end_is_passed_on() -> None:
    robot, line = here(CAMERA)
    robot.want(CAMERA, True)
    robot.on_message(CAMERA, CompressedImage(data=JPEG_START))
    assert [topic for topic, _ in robot.read(50.0)] == [CAMERA]
    robot.close()
    assert (line.wanted, line.closed) == ([(CAMERA, True)], True)


def test_pictures_that_are_no_jpeg_are_left_out_and_that_is_said_once() -> None:
    robot, _ = here(CAMERA)
    for _ in range(3):
        robot.on_message(CAMERA, CompressedImage(format="png", data=b"\x89PNG"))
    said = "The camera's pictures are png, not JPEG: they are left out."
    png = [KeyValue("format", "png")]
    refused = Event(level="warn", kind="robot", text=said, code="camera_unreadable", parameters=png)
    assert robot.read(50.0) == [("/events", refused)]


def test_a_robot_in_others_hands_is_not_driven_until_they_let_go() -> None:
    robot, line = here()
    robot.drive(SPEED)
    robot.on_held("The robot is driven by Fred: ask there, or wait until it is released.")
    line.sent.clear()
    robot.drive(SPEED)
    robot.read(20.0)
    assert line.sent == []
    assert robot.trouble == "The robot is driven by Fred: ask there, or wait until it is released."
    robot.on_held("")
    robot.drive(SPEED)
    assert (robot.trouble, line.sent) == ("", [SPEED])


def test_whose_hands_it_was_in_is_forgotten_with_the_link() -> None:
    robot, _ = here()
    robot.on_held("The robot is driven by Fred.")
    robot.on_lost("The connection was cut.")
    assert robot.trouble == "The robot cannot be reached: the connection was cut."
    robot.on_found(found())
    assert robot.trouble == ""


def test_one_that_is_found_in_others_hands_is_left_alone() -> None:
    robot, line = here()
    robot.on_lost("The connection was cut.")
    robot.on_held("The robot is on a task of its own.")
    robot.on_found(found())
    line.sent.clear()
    robot.read(20.0)
    assert line.sent == []


def test_a_password_in_the_address_is_not_told() -> None:
    robot = ForeignRobot("ws://me:secret@robot:9090", connect=Line(nobody))
    assert robot.info.name == "Robot at robot:9090"


def test_a_command_from_before_a_silence_is_not_said_again_and_rest_is_until_it_is_over() -> None:
    robot, line = here("/odom")
    robot.drive(SPEED)
    line.silent = True
    for number in range(10):
        robot.read(100.0 + number * REPEAT_PERIOD)
    assert robot.trouble == SILENT_SENTENCE
    line.sent.clear()
    line.silent = False
    for number in range(REST_REPEATS + 5):
        robot.read(102.0 + number * REPEAT_PERIOD)
    assert robot.trouble == ""
    assert line.sent == [REST] * REST_REPEATS


def test_a_command_that_was_in_force_when_others_took_the_robot_is_not_said_when_they_give_it_back() -> None:
    robot, line = here("/odom")
    robot.drive(SPEED)
    line.sent.clear()
    robot.on_held("The robot is driven by Fred.")
    robot.read(100.0)
    robot.read(101.0)
    robot.on_held("")
    robot.read(102.0)
    robot.read(103.0)
    assert line.sent == []


def test_a_picture_is_announced_as_it_comes_and_given_once_by_whoever_asks_first() -> None:
    robot, _ = here(CAMERA, "/odom")
    calls: list[int] = []
    robot.on_pictures(lambda: calls.append(1))
    robot.on_message("/odom", Odometry())
    assert calls == []
    for number in (1, 2):
        robot.on_message(CAMERA, CompressedImage(Header(Time.at(5.0)), data=JPEG_START + bytes([number])))
    assert calls == [1, 1]
    [(topic, picture)] = robot.pictures(10.0)
    assert isinstance(picture, CompressedImage)
    assert (topic, picture.data, picture.header.stamp.seconds) == (CAMERA, JPEG_START + b"\2", 10.0)
    assert [each for each, _ in robot.read(11.0)] == ["/odom"]
    assert robot.pictures(11.0) == []
    robot.on_pictures(None)
    robot.on_message(CAMERA, CompressedImage(data=JPEG_START))
    assert calls == [1, 1]
    assert [each for each, _ in robot.read(12.0)] == [CAMERA]
