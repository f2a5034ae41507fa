"""What the drive screens of every kind do alike: what holds on lies over nothing that would be seen only in part."""

from __future__ import annotations

from app.layout.rects import Rect
from app.link.feeds import Post
from app.screens.drive.driving_base import CHIP
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Check, Checklist, RobotInfo
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

DRONE = RobotInfo(
    name="Drone-1", kind="quadrotor", model="ardrone", max_speed=4.0, tasks=["take_off", "land"]
)


def test_what_is_wrong_with_a_drone_is_read_upright_without_anything_seen_only_in_part(
    driving: Glass, robot: FakeRobot
) -> None:
    before = driving.app.screens["drive"]
    robot.publish("/robot/info", DRONE)
    driving.until(lambda: driving.app.screens["drive"] is not before, "the screen of before")
    screen = driving.app.screens["drive"]
    body = Rect(0, 60, 412, 774)
    screen.session.checks.choose(False)
    robot.publish("/checklist", Checklist(checks=[Check("place", "bad", "It is not placed.")]))
    driving.until(lambda: screen.checks.height > 0, "no checks")
    screen.arrange(body, "tall", 1.0)
    driving.stage.frames(2)
    (tape,) = screen.places["top"]
    assert screen.low.y > screen.arranged["senses"].top
    assert (screen.low.top < tape.y, screen.video.show_chip) == (True, True)
    screen.session.checks.choose(True)
    screen.tick()
    driving.stage.frames(3)
    assert screen.low.top < tape.y, "the picture has room for both"
    assert (tape.right > 0, screen.video.show_chip) == (True, True)
    assert screen.low.top < screen.video.top - screen.video.insets[3] - 8 - CHIP[1], (
        "below the picture's words"
    )


def test_the_picture_says_how_late_it_is_beside_what_lies_there_and_leaves_the_rest_out(
    driving: Glass, robot: FakeRobot
) -> None:
    before = driving.app.screens["drive"]
    robot.publish("/robot/info", DRONE)
    driving.until(lambda: driving.app.screens["drive"] is not before, "the screen of before")
    screen = driving.app.screens["drive"]
    video = screen.video
    video.frame_size, video.rate, video.latency = (640, 480), 3.0, 0.657
    screen.session.checks.choose(False)
    robot.publish("/checklist", Checklist(checks=[Check("stop", "unknown", "STOP was not tested.")]))
    driving.until(lambda: screen.checks.height > 0, "no checks")
    screen.arrange(Rect(0, 60, 412, 774), "tall", 1.0)
    driving.stage.frames(2)
    (low,) = screen.checks_place
    chip, beside = video.top - video.insets[3] - 8 - CHIP[1], Rect(200, 0, low.width, low.height)
    screen.hide_chip([Rect(beside.x, chip, beside.width, beside.height)])
    assert video.chip_text() == "3 fps · 657 ms late"
    assert video.show_chip
    assert video.x + video.insets[0] + 8 + video.chip_room < beside.x
    screen.hide_chip([Rect(60, chip, beside.width, beside.height)])
    assert not video.show_chip, "there is no room for the least of it"

    way = Odometry(twist=TwistWithCovariance(Twist.planar(1.0, 0.0)))
    screen.session.feeds.put("/odom", Post(way, screen.session.now(), 1))
    screen.tick()
    driving.stage.frames(2)
    assert screen.checks_place == [], "it has moved, and nothing is bad"
    assert (video.show_chip, video.chip_text()) == (True, "3 fps · 657 ms late")
