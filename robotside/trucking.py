from __future__ import annotations
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.wheeling import Wheeling

__all__ = ["Trucking", "girth"]


def girth(info: RobotInfo) -> float:
    return 0.36 * info.radius


class Trucking(Wheeling):
    pass
