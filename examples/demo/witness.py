"""A second client, which only watches what the robot really does."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterable
from itertools import pairwise
from typing import Any

from bridge.client import RemoteRobot
from bridge.msgs import Msg
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import Bumper, Event

__all__ = ["Truth", "Witness"]

Truth = tuple[float, float, float, float]
"""(stamp [s, robot clock], x [m], y [m], yaw [rad]) in `map`."""

LATEST = (
    "/pose",
    "/task/status",
    "/task/progress",
    "/control/status",
    "/intruders",
    "/mission",
    "/battery_state",
    "/places",
    "/task/queue",
    "/manoeuvre",
    "/limits",
)
"""Topics of every robot."""


class Witness:
    """Keeps the truth of a run: every true pose, every contact, and the newest of what the robot says."""

    def __init__(self, url: str, also: Iterable[str] = ()) -> None:
        """Watches the robot at `url`; of `also`, topics that not every robot has, it keeps the newest too."""
        self._lock = threading.Lock()
        self._path: list[Truth] = []
        self._heights: list[tuple[float, float]] = []
        self._newest: dict[str, Msg] = {}
        self.events: list[Event] = []
        self.contacts = 0
        """Times that the bumper was pressed."""
        self._pressed = False
        self._robot = RemoteRobot(url)
        self._robot.on("/sim/ground_truth", self._on_truth)
        self._robot.on("/bumper", self._on_bumper)
        self._robot.on("/events", self.events.append)
        for topic in (*LATEST, *also):
            self._robot.on(topic, lambda msg, topic=topic: self._newest.__setitem__(topic, msg))

    def close(self) -> None:
        """Leave."""
        self._robot.close()

    def __getitem__(self, topic: str) -> Any:
        """The newest message of a topic; None before the first."""
        return self._newest.get(topic)

    def _on_truth(self, msg: Odometry) -> None:
        place, turn = msg.pose.pose.position, msg.pose.pose.orientation
        yaw = 2 * math.atan2(turn.z, turn.w)
        with self._lock:
            self._path.append((msg.header.stamp.seconds, place.x, place.y, math.remainder(yaw, math.tau)))
            self._heights.append((msg.header.stamp.seconds, place.z))

    def _on_bumper(self, msg: Bumper) -> None:
        self.contacts += msg.pressed and not self._pressed
        self._pressed = msg.pressed

    @property
    def path(self) -> list[Truth]:
        """All true poses so far, oldest first."""
        with self._lock:
            return self._path[:]

    @property
    def truth(self) -> Truth:
        """The newest true pose; NaN before the first."""
        with self._lock:
            return self._path[-1] if self._path else (math.nan,) * 4  # type: ignore[return-value]

    def heights(self, since: float = -math.inf) -> list[float]:
        """True heights above the map's origin from `since` [s, robot clock] on [m], oldest first; below water negative."""
        with self._lock:
            return [height for stamp, height in self._heights if stamp >= since]

    @property
    def now(self) -> float:
        """The robot's clock at the newest true pose [s]."""
        return self.truth[0]

    def since(self, stamp: float) -> list[Truth]:
        """True poses from `stamp` [s, robot clock] on."""
        return [pose for pose in self.path if pose[0] >= stamp]

    def distance(self, x: float, y: float) -> float:
        """From the robot to (x, y) in `map` [m]."""
        return math.dist(self.truth[1:3], (x, y))

    def nearest(self, x: float, y: float, since: float = -math.inf) -> float:
        """Least distance that the robot had to (x, y) in `map` since `stamp` [m]; inf when it was not seen."""
        return min((math.dist(pose[1:3], (x, y)) for pose in self.since(since)), default=math.inf)

    def spread(self, since: float) -> float:
        """Farthest that the robot was from where it stood at `since` [m]."""
        poses = self.since(since)
        return max((math.dist(pose[1:3], poses[0][1:3]) for pose in poses), default=math.nan)

    def driven(self, since: float) -> float:
        """Length of the way since `since` [s, robot clock], in [m]."""
        return sum(math.dist(one[1:3], two[1:3]) for one, two in pairwise(self.since(since)))

    def fast(self, seconds: float) -> float:
        """Mean speed along the way of the last `seconds` of the robot's time [m/s]; NaN before."""
        poses = self.since(self.now - seconds)
        if len(poses) < 2:
            return math.nan
        way = sum(math.dist(one[1:3], two[1:3]) for one, two in pairwise(poses))
        return way / (poses[-1][0] - poses[0][0])

    def rested(self, since: float, slow: float) -> float:
        """How long after `since` [s, robot clock] it was slower than `slow` [m/s] for good [s]; NaN while it is not."""
        poses = self.since(since)
        moving = [
            two[0] for one, two in pairwise(poses) if math.dist(one[1:3], two[1:3]) > slow * (two[0] - one[0])
        ]
        if not poses or (moving and moving[-1] == poses[-1][0]):
            return math.nan
        return moving[-1] - since if moving else 0.0

    def speed(self) -> float:
        """Over the last three true poses [m/s]; NaN before."""
        last = self.path[-3:]
        if len(last) < 3 or last[-1][0] <= last[0][0]:
            return math.nan
        return math.dist(last[-1][1:3], last[0][1:3]) / (last[-1][0] - last[0][0])


def matches(
    found: Iterable[tuple[float, float]], real: Iterable[tuple[float, float]], within: float
) -> list[int]:
    """How many of `found` lie `within` [m] of each of `real`."""
    found = list(found)
    return [sum(math.dist(one, place) <= within for one in found) for place in real]
