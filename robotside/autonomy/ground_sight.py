"""The sight of the ground below a robot that flies: pictures, and how it hung in the air when each was taken."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from bridge.core.topics import camera_topics
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage, Imu, Range
from robotside.core.pose2 import Pose2
from robotside.core.topic_demand import Demand
from robotside.localisation.odometry_track import OdometryTrack
from robotside.perception.cage_finder import FrontView
from robotside.perception.pad_finder import DOWN, GroundView
from robotside.tasks.behaviours.situation import Situation

__all__ = ["GroundSight"]

MAX_TILTS = 60
"""Attitudes that are kept: those of the last second."""


class GroundSight:
    """Has the situation know what is below; asks for pictures only while they are wanted."""

    def __init__(
        self, cameras: Sequence[str], situation: Situation, wheels: OdometryTrack, demand: Demand
    ) -> None:
        """Of a robot with `cameras`; `wheels` are its ways in the frame of the odometry."""
        self._situation, self._wheels, self._demand = situation, wheels, demand
        self._topic = camera_topics(cameras).get(DOWN, "")
        self._tilts: deque[tuple[float, float, float]] = deque(maxlen=MAX_TILTS)

    def on_message(self, topic: str, msg: Msg) -> None:
        """Take in one message of the robot."""
        here = self._situation
        if topic == "/range/down" and isinstance(msg, Range):
            here.below = msg.range
        elif topic == "/imu/data" and isinstance(msg, Imu):
            turned = msg.orientation
            self._tilts.append((msg.header.stamp.seconds, turned.roll, turned.pitch))
        elif topic == self._topic and isinstance(msg, CompressedImage):
            stamp = msg.header.stamp.seconds
            roll, pitch = self._tilt(stamp)
            wheels = self._wheels.at(stamp) or here.odom
            here.ground = GroundView(msg.data, stamp, wheels, roll, pitch, here.below)

    def ahead(self, image: CompressedImage, wheels: Pose2, height: float) -> FrontView:
        """A picture of what is ahead, taken at `wheels` and a `height` [m], with the attitude that belongs to it."""
        stamp = image.header.stamp.seconds
        return FrontView(image.data, stamp, wheels, *self._tilt(stamp), height)

    def update(self) -> None:
        """Ask for pictures of the ground, or no longer; call it each tick."""
        if self._topic:
            self._demand.set(self._topic, "task", self._situation.looks_down)

    def _tilt(self, stamp: float) -> tuple[float, float]:
        """Roll and pitch at a time [s]; level before any was measured."""
        near = min(self._tilts, key=lambda tilt: abs(tilt[0] - stamp), default=(stamp, 0.0, 0.0))
        return near[1], near[2]
