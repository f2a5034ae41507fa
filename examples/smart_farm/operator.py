"""The operator of the farm's robot: sends it to a tree, drives it by hand up to an orange, and touches that with its arm."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

from bridge.client import RemoteRobot
from bridge.core.errors import BridgeError
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseArray,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Twist,
)
from bridge.msgs.pilothouse_msgs import (
    ArmOrder,
    MoveArmRequest,
    MoveArmResponse,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from bridge.msgs.std_msgs import Header
from examples.smart_farm.detector import TOPIC
from examples.smart_farm.oranges import RADIUS

__all__ = ["Farmer", "NotDone", "Orange"]

FOOT = (0.052, 0.0, 0.4765)
"""Shoulder of the arm on a patrol robot, in `base_link` [m]."""
REACH = 0.36
"""An orange is touched from this far, from the shoulder to its middle [m]."""
HIGHEST = 0.30
"""Oranges more than this above the shoulder are left hanging [m]."""
NEAR = 1.4
"""Oranges farther ahead hang on other trees [m]."""
LOOKS = 0.5
"""So far from the place of the tree its oranges are looked for [m]."""
SAME = 0.02
"""An orange that is seen twice within this is where it seems to be [m]."""
PERIOD = 0.05
"""Of drive commands [s]."""
PATIENCE = 300.0
"""Nothing takes longer [s]."""
CLIENT = {"client_id": "farmer", "client_name": "farmer"}

Orange = tuple[float, float, float]
"""In the frame `odom` [m]."""


class NotDone(Exception):
    """Why not, as one sentence."""


class Farmer:
    """Drives one robot, whose newest messages it keeps."""

    def __init__(self, robot: RemoteRobot) -> None:
        """`robot` is connected, and a detector watches its camera."""
        self._robot = robot
        self._newest: dict[str, Any] = {}
        for topic, kind in (("/odom", None), ("/places", None), ("/task/status", None), (TOPIC, PoseArray)):
            robot.on(topic, lambda msg, topic=topic: self._newest.__setitem__(topic, msg), kind)

    def place(self, x: float, y: float, yaw: float) -> None:
        """Tell the robot where it stands on its map [m, rad], which it does not know after its first start."""
        here = Pose(Point(x, y, 0.0), Quaternion.from_yaw(yaw))
        self._robot.publish(
            "/initialpose", PoseWithCovarianceStamped(Header(frame_id="map"), PoseWithCovariance(here))
        )

    def go_to(self, name: str) -> None:
        """Have the robot drive to a little before a place with a name, looking as the place does."""
        self._move(ArmOrder(pose="rest"))
        places = self._until(lambda: self._newest.get("/places"), "the places").places
        place = next((each for each in places if each.name == name), None)
        if place is None:
            raise NotDone(f"The robot knows no place {name!r}.")
        yaw = 0.0 if math.isnan(place.yaw) else place.yaw
        goal = Waypoint(place.x - LOOKS * math.cos(yaw), place.y - LOOKS * math.sin(yaw), yaw)
        order = TaskOrder(task="go_to", goals=[goal])
        self._until(lambda: self._newest.pop("/task/status", None), "its task")  # that of before
        answer = self._robot.call("/task/start", StartTaskRequest(**CLIENT, order=order))
        if not answer.success:
            raise NotDone(answer.message)
        status = self._until(self._over, "the end of the way")
        if status.state != "SUCCEEDED":
            raise NotDone(status.reason)

    def _over(self) -> Any:
        status = self._newest.get("/task/status")
        return status if status is not None and status.state in ("SUCCEEDED", "FAILED", "CANCELED") else None

    def look(self) -> list[Orange]:
        """The oranges that the arm can reach from somewhere, the nearest first, once two pictures show the same ones."""
        before: list[tuple[float, ...]] = []
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            self._newest.pop(TOPIC, None)
            seen = self._until(lambda: self._newest.get(TOPIC), "the detector's answer").poses
            places = sorted((p.position.x, p.position.y, p.position.z) for p in seen)
            near = [at for at in places if at[0] < NEAR and abs(at[2] - FOOT[2]) < HIGHEST]
            if near and _alike(near, before):
                x, y, yaw = self._pose()
                return [
                    (x + a * math.cos(yaw) - b * math.sin(yaw), y + a * math.sin(yaw) + b * math.cos(yaw), c)
                    for a, b, c in near
                ]
            before = near
        raise NotDone("No oranges are seen.")

    def touch(self, orange: Orange) -> bool:
        """Drive up to an orange and touch it; whether the hand feels it."""
        self._move(ArmOrder(pose="rest"))
        self._approach(orange)
        way = [there - at for there, at in zip(self._from_here(orange), FOOT, strict=True)]
        share = 1 - 0.8 * RADIUS / math.hypot(*way)
        tip = [at + share * each for at, each in zip(FOOT, way, strict=True)]
        return "touches" in self._move(ArmOrder(point=Point(*tip)))

    def _move(self, order: ArmOrder) -> str:
        """Move the arm and wait until it is there; what became of it."""
        request = MoveArmRequest(**CLIENT, order=order, wait=True)
        answer = self._robot.call("/arm/move", request, MoveArmResponse, timeout=PATIENCE)
        if not answer.success:
            raise NotDone(answer.message)
        return answer.message

    def _approach(self, orange: Orange) -> None:
        """Drive by hand until the orange is straight ahead, and as near as the arm needs it."""
        level = math.sqrt(REACH**2 - min(REACH, abs(orange[2] - FOOT[2])) ** 2)
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            ahead, left, _ = self._from_here(orange)
            bearing, far = math.atan2(left, ahead), math.hypot(ahead, left) - FOOT[0] - level
            if abs(bearing) < 0.03 and abs(far) < 0.01:
                self._robot.publish("/cmd_vel", Twist())
                return
            speed = max(-0.15, min(0.15, far)) if abs(bearing) < 0.3 else 0.0
            self._robot.publish("/cmd_vel", Twist.planar(speed, max(-0.5, min(0.5, bearing))))
            time.sleep(PERIOD)
        self._robot.publish("/cmd_vel", Twist())
        raise NotDone("The robot did not come near the orange.")

    def _from_here(self, place: Orange) -> tuple[float, float, float]:
        """A place of `odom` in `base_link`."""
        x, y, yaw = self._pose()
        dx, dy = place[0] - x, place[1] - y
        return dx * math.cos(yaw) + dy * math.sin(yaw), dy * math.cos(yaw) - dx * math.sin(yaw), place[2]

    def _pose(self) -> tuple[float, float, float]:
        pose = self._until(lambda: self._newest.get("/odom"), "odometry").pose.pose
        return pose.position.x, pose.position.y, pose.orientation.yaw

    def _until(self, value: Callable[[], Any], what: str) -> Any:
        """The first value that is not None."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            found = value()
            if found is not None:
                return found
            time.sleep(0.02)
        raise BridgeError(f"The robot did not send {what}.")


def _alike(one: list[tuple[float, ...]], other: list[tuple[float, ...]]) -> bool:
    """The same places."""
    return len(one) == len(other) and all(math.dist(a, b) < SAME for a, b in zip(one, other, strict=True))
