"""One robot of each kind whose link is cut: the simulated vehicles on open ground, at their full speed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import FlightState, Manoeuvre
from sim.robot import ROBOTS, SimRobot

__all__ = ["KINDS", "Aloft", "Kind"]

OPEN_GROUND, CALM_WATER = (
    str(Path(__file__).with_name(name)) for name in ("open_ground.toml", "calm_water.toml")
)
"""Worlds. Without waves and current, for what drifts is never at rest over ground."""
CLIMBING = 3.0
"""So long a robot that flies is left to take off before it is measured [s]."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of robot to drive."""

    model: str
    """For `--robot sim:MODEL`."""
    world: str
    """For `--world`."""
    acceleration: float
    """Of the mean until it has its full speed [m/s2]."""
    braking: float
    """Of the mean until it is at rest, by its own drive and its surroundings [m/s2]."""
    rest: float = 0.02
    """Slower than this it is at rest as its odometry has it [m/s]; more where that wanders by itself."""

    @property
    def speed(self) -> float:
        """At most [m/s]."""
        return ROBOTS[self.model].parameters.limits.speed


KINDS = {
    "ackermann": Kind("commander", OPEN_GROUND, 2.0, 3.0),
    "boat": Kind("minnow", CALM_WATER, 1.0, 1.3, rest=0.1),
    "hexapod": Kind("aqua", CALM_WATER, 0.2, 0.2, rest=0.15),
    "quadrotor": Kind("ardrone", OPEN_GROUND, 2.0, 3.0, rest=0.15),
    "wheels": Kind("patrol", OPEN_GROUND, 1.0, 2.5),
}
"""By the kind in `/robot/info`; accelerations as the vehicles have them at full speed."""


class Aloft:
    """Fits `robotside.core.robot.Robot`: a robot that is in the air when it is first looked at, and again whenever it has landed."""

    trouble = ""

    def __init__(self, robot: SimRobot) -> None:
        """On the ground still."""
        self._robot, self._met = robot, False
        self.info = robot.info

    def drive(self, twist: Twist) -> None:
        """As the robot does."""
        self._robot.drive(twist)

    def stop(self) -> None:
        """As the robot does, once it is up."""
        if self._met:
            self._robot.stop()

    def read(self, now: float) -> Iterable[tuple[str, Msg]]:
        """As the robot does, which took off before the first call."""
        first: list[tuple[str, Msg]] = []
        if not self._met:
            self._met = True
            first = self._robot.read(now - CLIMBING)
            self._robot.manoeuvre(Manoeuvre(kind="take_off"))
        measured = first + self._robot.read(now)
        flying = [msg.phase for _, msg in measured if isinstance(msg, FlightState)]
        if flying and flying[-1] == "landed":
            self._robot.manoeuvre(Manoeuvre(kind="take_off"))
        return measured

    def want(self, topic: str, wanted: bool) -> None:
        """As the robot does."""
        self._robot.want(topic, wanted)

    def close(self) -> None:
        """As the robot does."""
        self._robot.close()
