"""The robot's camera that the operator watches."""

from __future__ import annotations

from app.link.capabilities import CAMERA
from app.session.robot_profile import RobotProfile
from bridge.core.topics import camera_topics
from bridge.msgs.vision_msgs import Detection2DArray

__all__ = ["CameraChoice"]


class CameraChoice:
    """The operator's choice among the cameras that one robot has."""

    def __init__(self, robot: RobotProfile) -> None:
        self._robot = robot
        self._chosen = ""
        """Name of the chosen camera; empty for the robot's first."""

    def wanted(self, watched: str | None) -> str | None:
        """Name of the camera to watch, as `Link.watch` takes it; `watched` until the robot's cameras are known."""
        robot = self._robot
        if robot.introduced:
            cameras = robot.info.cameras
            return self._chosen if self._chosen in cameras else next(iter(cameras), None)
        if robot.foreign and robot.capabilities is not None:
            return "" if robot.capabilities.source(CAMERA) else None
        return watched

    @property
    def topic(self) -> str:
        """The robot's name of the topic whose pictures are watched; empty while that is not known, and without a camera."""
        robot = self._robot
        if robot.introduced:
            return camera_topics(robot.info.cameras).get(self.wanted(None) or "", "")
        offer = robot.capabilities
        return (offer.source(CAMERA) or "") if robot.foreign and offer is not None else ""

    def choose_next(self) -> None:
        """Choose the robot's next camera, after the last the first; no change where it has one or none."""
        cameras = self._robot.info.cameras
        shown = self.wanted(None)
        if shown in cameras:
            self._chosen = cameras[(cameras.index(shown) + 1) % len(cameras)]

    @property
    def shows_first(self) -> bool:
        """The picture is of the robot's first camera, which it searches and whose field of view it publishes."""
        return not self._chosen or self._chosen == next(iter(self._robot.info.cameras), "")

    def detections_shown(self, found: Detection2DArray) -> Detection2DArray:
        """Detections that belong to the picture: all of `found` on the first camera, none on another."""
        return found if self.shows_first else Detection2DArray()
