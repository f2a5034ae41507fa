"""The robot side with a robot whose port reports what passes through it, `python -m bench.support.probe serve …`.

Prints a line of JSON for each: `["drive", at, forward, yaw rate]` and `["picture", at, stamp]`. `at` is `time.monotonic()`
[s], which all processes of a machine share; that of a picture is taken before the simulation begins to draw it.
"""

from __future__ import annotations

import json
import sys
import time
from collections import deque
from collections.abc import Iterable

import sim.robot
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.sensor_msgs import CompressedImage
from robotside.__main__ import main
from robotside.core.robot import Robot

__all__ = ["Probe"]

MAX_READS = 600
"""Reads that are remembered: a picture that is drawn beside the loop comes in a later one than it was taken in."""
STAMP_TOLERANCE = 1e-6
"""Of a stamp, which has whole nanoseconds [s]."""


class Probe:
    """Fits `robotside.core.robot.Robot`; passes everything on."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.info = robot.info
        self._reads: deque[tuple[float, float]] = deque(maxlen=MAX_READS)
        """Up to which moment it was read [s, robot clock], and when that began."""

    @property
    def trouble(self) -> str:
        """As the robot does."""
        return self._robot.trouble

    def drive(self, twist: Twist) -> None:
        """Report when the command came to the port."""
        report("drive", time.monotonic(), twist.linear.x, twist.angular.z)
        self._robot.drive(twist)

    def stop(self) -> None:
        """As the robot does."""
        self._robot.stop()

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """Report when the pictures were begun."""
        self._reads.append((now, time.monotonic()))
        measured = list(self._robot.read(now))
        for _, msg in measured:
            if isinstance(msg, CompressedImage):
                stamp = msg.header.stamp.seconds
                later = (at for until, at in self._reads if until >= stamp - STAMP_TOLERANCE)
                began = next(later, self._reads[-1][1])
                report("picture", began, stamp)
        return measured

    def want(self, topic: str, wanted: bool) -> None:
        """As the robot does."""
        self._robot.want(topic, wanted)

    def close(self) -> None:
        """As the robot does."""
        self._robot.close()


def report(*values: object) -> None:
    """Print a line of JSON."""
    print(json.dumps(values), flush=True)


if __name__ == "__main__":
    make = sim.robot.make_several
    sim.robot.make_several = lambda *args, **kwargs: [Probe(robot) for robot in make(*args, **kwargs)]  # type: ignore[assignment,return-value,misc]
    sys.exit(main())
