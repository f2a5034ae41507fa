"""Traffic of a robot, as the benches of the bridge send it: the messages, their topics and their usual rates."""

from __future__ import annotations

import math
import random

from bridge.msgs import Msg
from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.msgs.std_msgs import Header, Time

__all__ = ["CAMERA", "LARGE_SCAN", "MESSAGES", "ODOM", "RATES", "SCAN"]

ODOM, SCAN, CAMERA = "/odom", "/scan", "/camera/image/compressed"
RATES = {CAMERA: 30.0, ODOM: 50.0, SCAN: 10.0}
"""Messages that one connection carries beside the commands [Hz]."""

_dice = random.Random(1)
_header = Header(stamp=Time(1763719200, 123456789), frame_id="odom")


def _diagonal(value: float) -> list[float]:
    return [value if place % 7 == 0 else 0.0 for place in range(36)]


def _scan(beams: int) -> LaserScan:
    return LaserScan(
        header=_header,
        angle_min=-math.pi * 0.75,
        angle_max=math.pi * 0.75,
        angle_increment=math.pi * 1.5 / beams,
        range_min=0.1,
        range_max=30.0,
        ranges=Float32Array([_dice.uniform(0.5, 29.0) for _ in range(beams)]),
    )


MESSAGES: dict[str, Msg] = {
    ODOM: Odometry(
        header=_header,
        child_frame_id="base_link",
        pose=PoseWithCovariance(
            pose=Pose(
                position=Point(1.2345678901, -2.3456789012, 0.0),
                orientation=Quaternion(0.0, 0.0, 0.3826834323650898, 0.9238795325112867),
            ),
            covariance=_diagonal(0.0012345678901234),
        ),
        twist=TwistWithCovariance(
            twist=Twist(linear=Vector3(0.4567890123, 0.0, 0.0), angular=Vector3(0.0, 0.0, -0.1234567)),
            covariance=_diagonal(0.0023456789012345),
        ),
    ),
    SCAN: _scan(1080),
    CAMERA: CompressedImage(header=_header, format="jpeg", data=b"\xff\xd8" + _dice.randbytes(45_100)),
}
"""An Odometry of 0.9 kB as text, a scan of 1080 beams (20 kB as text) and a picture (45 kB, 60 kB as text)."""
LARGE_SCAN = _scan(2430)
"""45 kB as text."""
