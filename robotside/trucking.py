from __future__ import annotations
import math
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.pose2 import Points
from robotside.robot import Robot
from robotside.wheeling import Wheeling

__all__ = ["Trucking", "girth"]


def girth(info: RobotInfo) -> float:
    return 0.36 * info.radius


class Trucking(Wheeling):
    def __init__(self, robot: Robot) -> None:
        super().__init__(robot)
        self.turning = 4.0

    def free(self, curvature: float, points: Points) -> float:
        return math.inf
