"""The robot side with a robot that publishes much more than a link carries, `python -m bench.support.flooding serve …`.

A subscriber of `/sim/ground_truth` is offered it RATE times a second.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable

import sim.robot
from bridge.msgs import Msg
from bridge.msgs.nav_msgs import Odometry
from robotside.__main__ import main
from robotside.core.robot import Robot

__all__ = ["RATE", "TRUTH"]

TRUTH = "/sim/ground_truth"
RATE = 2500.0
"""[Hz]"""


class Flooding:
    """Fits `robotside.core.robot.Robot`; passes everything on, and one thing again and again."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self.info = robot.info
        self.drive, self.stop, self.close = robot.drive, robot.stop, robot.close
        self._wanted = False
        self._last: float | None = None
        self._truth = Odometry()

    @property
    def trouble(self) -> str:
        """As the robot does."""
        return self._robot.trouble

    def want(self, topic: str, wanted: bool) -> None:
        """Keep the message that is repeated."""
        if topic == TRUTH:
            self._wanted, self._last = wanted, None
        self._robot.want(topic, wanted)

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """With as many truths as are due."""
        yield from self._watched(self._robot.read(now))
        if self._wanted:
            due = int((now - (now if self._last is None else self._last)) * RATE)
            self._last = now if self._last is None else self._last + due / RATE
            for _ in range(due):
                yield TRUTH, self._truth

    def _watched(self, measured: Iterable[tuple[str, Msg]]) -> Iterable[tuple[str, Msg]]:
        for topic, msg in measured:
            if isinstance(msg, Odometry) and topic == TRUTH:
                self._truth = msg
            yield topic, msg


if __name__ == "__main__":
    make = sim.robot.make_several
    sim.robot.make_several = lambda *args, **kwargs: [Flooding(robot) for robot in make(*args, **kwargs)]  # type: ignore[assignment,return-value,misc]
    sys.exit(main())
