"""The sensors of a vehicle together: each measures at its own rate."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseWithCovariance,
    Quaternion,
    Twist,
    TwistWithCovariance,
    Vector3,
)
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.std_msgs import Header, Time
from sim.core.sensor_schedule import Schedule
from sim.core.shapes import rotate_back
from sim.physics.backend_bullet import State

__all__ = [
    "AFTER_GROUND",
    "AFTER_LASER",
    "AFTER_WHEELS",
    "Measure",
    "Measurement",
    "SensorSuite",
    "as_odometry",
]

AFTER_WHEELS, AFTER_LASER, AFTER_GROUND = 4, 8, 16
"""Steps between the odometry and what measures next: the laser, then what looks at the ground, then what echoes; a robot side takes
four steps at a time."""

Measurement = tuple[str, Msg]
"""A topic and its message."""
Measure = Callable[[State, float], Iterable[Measurement]]
"""Messages of one sensor on a body in a state, with a stamp [s]."""


class SensorSuite:
    """Reads every sensor when it is due, in the order in which they were added."""

    def __init__(self) -> None:
        """No sensors yet."""
        self._sensors: dict[str, tuple[float, Measure]] = {}
        self._after: dict[str, int] = {}
        self._schedule: Schedule | None = None
        self._off: set[str] = set()
        """Topics that are switched off."""
        self._dark: set[str] = set()
        """Sensors that have nothing to tell but these, as far as that is known."""

    def __contains__(self, name: str) -> bool:
        return name in self._sensors

    def add(self, name: str, rate: float, measure: Measure, *, after: int = 0) -> None:
        """One more, that measures `rate` times a second; before the first `measure`.

        It does so some steps `after` the others, so that a robot side has not to take in all of them at once.
        """
        if name in self._sensors:
            raise ValueError(f"There is a sensor {name!r} already.")
        self._sensors[name] = (rate, measure)
        self._after[name] = after

    def switch(self, topic: str, on: bool) -> None:
        """Measure what comes on `topic`, or no longer; a sensor that tells nothing else does not work meanwhile."""
        (self._off.discard if on else self._off.add)(topic)
        self._dark.clear()

    def anything_due(self, step: int) -> bool:
        """Whether any sensor measures after `step`; a step after which none does need not be measured."""
        return self._planned().anything_due(step)

    def is_due(self, name: str, step: int) -> bool:
        """Whether the sensor of this name measures after `step`, which has not been measured yet."""
        return name in self._sensors and self._planned().is_due(name, step)

    def measure(self, step: int, state: Callable[[], State], stamp: float) -> Iterator[Measurement]:
        """Measurements that are due after `step`; `state` is called only if there is one."""
        due = self._planned().due(step)
        if not due:
            return
        now = state()
        for name in due:
            if not self._off:
                yield from self._sensors[name][1](now, stamp)
            elif name not in self._dark:
                yield from self._measure_in_part(name, now, stamp)

    def _measure_in_part(self, name: str, state: State, stamp: float) -> Iterator[Measurement]:
        """What one sensor tells of what is not switched off."""
        measured = list(self._sensors[name][1](state, stamp))
        if measured and all(topic in self._off for topic, _ in measured):
            self._dark.add(name)
        yield from (each for each in measured if each[0] not in self._off)

    def _planned(self) -> Schedule:
        if self._schedule is None:
            self._schedule = Schedule({name: rate for name, (rate, _) in self._sensors.items()}, self._after)
        return self._schedule


def as_odometry(state: State, stamp: float, frame: str = "map") -> Odometry:
    """A body's `state` as a message, `frame` to `base_link`; the velocity is the centre of mass's."""
    ahead = rotate_back(state.rotation, state.velocity)
    turning = rotate_back(state.rotation, state.turning)
    return Odometry(
        Header(Time.at(stamp), frame),
        "base_link",
        PoseWithCovariance(Pose(Point(*state.position), Quaternion(*state.rotation))),
        TwistWithCovariance(Twist(Vector3(*ahead), Vector3(*turning))),
    )
