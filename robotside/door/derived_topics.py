"""Topics derived from our messages, for clients that do not know them.

A ring of sonars as `/sonar/0`, `/sonar/1`, …, each motor's temperature as `/temperature/NAME` and events as `/rosout`; only
what somebody wants.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from bridge.core.topics import SONARS, TEMPERATURE, Topic, named
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import Event, MotorArray, SonarRing
from bridge.msgs.rosgraph_msgs import Log
from bridge.msgs.sensor_msgs import Range, Temperature
from bridge.msgs.std_msgs import Header
from robotside.core.bus import Bus

__all__ = ["DerivedTopics"]

_EARLY = 0.01
"""A temperature may come so much before it is due [s]: motors are measured at a rate of their own."""
MAX_MOTORS = 64
"""Motors that have a topic of their own."""
LOG = "/rosout"
"""Where ROS tools look for what programs say."""
_LEVELS = {"info": Log.INFO, "ok": Log.INFO, "warn": Log.WARN, "alarm": Log.ERROR}
_NODE = "/pilothouse"
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)


class DerivedTopics:
    """Listens on the bus and publishes there what is wanted."""

    def __init__(self, bus: Bus) -> None:
        """Which motors there are is taken from the first `/motors`, which a robot tells at its start."""
        self._bus = bus
        self._wanted: set[str] = set()
        self._motors: tuple[str, ...] = ()
        self._due: dict[str, float] = {}
        self._leave = (
            bus.subscribe("/sonar", self._ring),
            bus.subscribe("/motors", self._warmth),
            bus.subscribe("/events", self._log),
        )

    @property
    def topics(self) -> tuple[Topic, ...]:
        """Those that only this robot has: the temperature of each of its motors."""
        return tuple(named(TEMPERATURE, name) for name in self._motors)

    def want(self, topic: str, wanted: bool) -> None:
        """`topic` is wanted from now on, or no longer; topics that are not derived are ignored."""
        if wanted:
            self._wanted.add(topic)
        else:
            self._wanted.discard(topic)
            self._due.pop(topic, None)

    def close(self) -> None:
        """Listen no longer."""
        for leave in self._leave:
            leave()

    def _ring(self, _: str, msg: Msg) -> None:
        if not isinstance(msg, SonarRing) or not self._wanted:
            return
        for number, distance in enumerate(msg.ranges[:SONARS]):
            topic = f"/sonar/{number}"
            if topic in self._wanted:
                self._bus.publish(topic, _one(msg, number, float(distance)))

    def _warmth(self, _: str, msg: Msg) -> None:
        if not isinstance(msg, MotorArray):
            return
        self._motors = self._motors or tuple(_nameable(msg.names))
        now = msg.header.stamp.seconds
        for name, temperature in zip(msg.names, msg.temperatures, strict=False):
            topic = _warm(name)
            if topic in self._wanted and self._falls(topic, now):
                self._bus.publish(topic, Temperature(msg.header, float(temperature)))

    def _log(self, _: str, msg: Msg) -> None:
        """Log an event; one that comes again because somebody acknowledged it is not logged twice."""
        if LOG in self._wanted and isinstance(msg, Event) and not msg.acknowledged_by:
            level = _LEVELS.get(msg.level, Log.INFO)
            line = Log(Header(msg.stamp), level, _NODE, msg.text, function=msg.code, topics=["/events"])
            self._bus.publish(LOG, line)

    def _falls(self, topic: str, now: float) -> bool:
        """It is time for another one; on average they come at the rate, at any rate of the motors."""
        due, period = self._due.get(topic, -math.inf), 1 / TEMPERATURE.rate
        if due - period <= now < due - _EARLY:
            return False
        self._due[topic] = (due if abs(now - due) < period else now) + period
        return True


def _one(ring: SonarRing, number: int, distance: float) -> Range:
    """One sonar of the ring; along x of its own frame, as ROS has it."""
    header = type(ring.header)(ring.header.stamp, f"sonar_{number}")
    return Range(header, Range.ULTRASOUND, ring.field_of_view, ring.range_min, ring.range_max, distance)


def _warm(name: str) -> str:
    return named(TEMPERATURE, name).name


def _nameable(names: Iterable[str]) -> list[str]:
    """The names that can be part of a topic's, each once."""
    return [name for name in dict.fromkeys(names) if _NAME.fullmatch(name)][:MAX_MOTORS]
