"""What the drive screens of every kind do alike: what holds on lies over nothing that would be seen only in part."""

from __future__ import annotations

from app.rects import Rect
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
    assert screen.low.top > screen.arranged["top"].y
    assert (tape.right < 0, screen.video.show_chip) == (True, False)
