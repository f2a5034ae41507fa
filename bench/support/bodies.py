"""The robot side with robots that weigh nothing, `python -m bench.support.bodies serve --robot sim:patrol,patrol,… --name 0,1,…`.

They move exactly as told and measure no laser, so that one computer serves many; all else is the robot side that users start. Prints a line of
JSON for each command at a port: `[NUMBER, "drive", at, forward, yaw rate]` and `[NUMBER, "stop", at]`, `at` being `time.monotonic()` [s].
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from typing import Any

import sim.robot
from bench.support.probe import report
from bridge.msgs.geometry_msgs import Twist
from robotside.__main__ import main
from robotside.core.robot import Robot
from tests.fakes import FakeRobot

__all__ = ["Body"]


class Body(FakeRobot):
    """Reports every command."""

    def __init__(self, number: int) -> None:
        super().__init__(beams=4)
        self.silent = {"/scan"}
        self._number = number

    def drive(self, twist: Twist) -> None:
        """Report when the command came to the port."""
        report(self._number, "drive", time.monotonic(), twist.linear.x, twist.angular.z)
        super().drive(twist)
        self.commands.clear()

    def stop(self) -> None:
        """Report the command to rest."""
        report(self._number, "stop", time.monotonic())
        super().stop()
        self.commands.clear()


def make(robots: Sequence[str], *_: Any, **__: Any) -> list[Robot]:
    """As many bodies as there are names."""
    return [Body(number) for number in range(len(robots))]


if __name__ == "__main__":
    sim.robot.make_several = make  # type: ignore[assignment]
    sys.exit(main())
