"""A station on a disk that takes its time, or has none left."""

from __future__ import annotations

import random
from collections.abc import Awaitable
from typing import Any

from bridge.msgs import Msg
from robotside.door.station_door import StationDoor
from robotside.records import Records
from robotside.records.database.rows import empty
from robotside.station.station import Station
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.records.disk import Disk

__all__ = ["FULL", "Slow"]

FULL = "The disk is full: nothing was stored."


class Slow:
    """A station on a disk that writes when it is told to."""

    def __init__(self) -> None:
        self.clock = 1000.0
        self._stored = empty()
        self.restart()

    def restart(self) -> None:
        """Start the robot side on what is on the disk."""
        self.disk = Disk()
        self.disk.room = 1000
        self.robot = FakeRobot()
        self.records = Records(self._stored, self.disk, lambda: None)
        self.station = Station(
            self.robot, self.records, now=1000.0, clock=lambda: self.clock, rng=random.Random(1)
        )
        self.door = StationDoor(self.station)
        self.now = 1000.0
        self.run(5.0)
        self.write()

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds * 60)):
            self.now += 1 / 60
            self.station.step(self.now)

    def ask(self, name: str, request: Msg) -> Msg | Awaitable[Msg]:
        return self.door.call(FakeClient("anna", self.clock), name, request)

    def write(self, problem: str = "") -> None:
        while self.disk.waiting:
            self.disk.answer(problem)

    def last(self, topic: str) -> Any:
        return self.station.bus.last(topic)
