"""Recordings for tests, written by the app's own recorder on a clock of the test's own."""

from __future__ import annotations

import math
from pathlib import Path

from app.link.recorder import PIECE, Recorder
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped, Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Event, RobotInfo
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time

START = 1_763_719_271.0
"""When recordings of tests begin [s since 1970]."""
PERIOD = 0.1
"""Between two messages [s]."""


def pose(x: float, y: float) -> PoseWithCovarianceStamped:
    return PoseWithCovarianceStamped(pose=PoseWithCovariance(pose=Pose(position=Point(x, y, 0.0))))


def odometry(speed: float) -> Odometry:
    whole = Odometry()
    twist = type(whole.twist)(twist=Twist.planar(speed, 0.0))
    return type(whole)(twist=twist)


def recorded(
    path: Path, seconds: float = 10.0, *, pieces: int = PIECE, picture: bytes = b"", name: str = "Patrol-1"
) -> Path:
    """A robot that drives along x ever faster, with an event every two seconds; `pieces` is how large each is [byte]."""
    now = START
    recorder = Recorder(path, wall=lambda: now, waiting=100_000, piece=pieces)
    recorder.put("/robot/info", RobotInfo(name=name, model="patrol", kind="ground"))
    for number in range(round(seconds / PERIOD) + 1):
        now = START + number * PERIOD
        recorder.put("/odom", odometry(number * 0.01 if number != 50 else 9.0))
        recorder.put("/pose", pose(number * 0.1, math.sin(number / 10)))
        if number % 20 == 10:
            stamp = Time(int(now), 0)
            level = "alarm" if number == 50 else "info"
            recorder.put("/events", Event(id=number, boot="a", level=level, text=f"At {number}", stamp=stamp))
        if picture and number % 5 == 0:
            recorder.put(
                "/camera/image/compressed", CompressedImage(Header(Time(int(now), 0)), "jpeg", picture)
            )
    recorder.close()
    assert not recorder.sentence
    return path
