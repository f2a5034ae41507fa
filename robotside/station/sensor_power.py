"""The power of a robot's sensors: what is switched off is not measured, whoever wants it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from robotside.core.robot import Robot, Switchable

__all__ = ["SensorPower"]


class SensorPower:
    """Stands before the demand for topics."""

    def __init__(self, robot: Robot, forget: Callable[[str], None]) -> None:
        """`forget(topic)` is called for each sensor that is switched off: nobody waits for it."""
        self._robot, self._forget = robot, forget
        self._wanted: set[str] = set()
        self._off: set[str] = set()

    def want(self, topic: str, wanted: bool) -> None:
        """An on-demand topic is wanted from now on, or no longer; it is made while it is switched on."""
        if topic not in self._off:
            self._robot.want(topic, wanted)
        (self._wanted.add if wanted else self._wanted.discard)(topic)

    def switch(self, topics: Iterable[str], on: bool) -> None:
        """Switch what comes on `topics` on or off; saying it twice changes nothing."""
        for topic in topics:
            if (topic not in self._off) == on:
                continue
            (self._off.discard if on else self._off.add)(topic)
            if isinstance(self._robot, Switchable):
                self._robot.switch(topic, on)
            if topic in self._wanted:
                self._robot.want(topic, on)
            if not on:
                self._forget(topic)
