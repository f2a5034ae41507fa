"""The simulated robot on a whole station, in virtual time."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from pathlib import Path

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    TaskOrder,
    TaskStatus,
    Waypoint,
)
from robotside.door.station_door import StationDoor
from robotside.station.station import Station
from sim.robot import SimRobot
from tests.fakes import FakeClient
from tests.robotside.scene import records_at

__all__ = ["HOME", "Run"]

TICK = 1 / 30
HOME = Waypoint(-17.5, -12.0, math.pi / 2)


class Run:
    """The simulated robot with its station, driven by hand through time."""

    def __init__(self, robot: SimRobot, state: Path) -> None:
        self.robot = robot
        self.now = 1000.0
        self.anna = FakeClient("anna", self.now)
        self.station = Station(
            robot, records_at(state), now=self.now, clock=lambda: self.now, rng=random.Random(1)
        )
        self.door = StationDoor(self.station)
        self.until(lambda: self.station.autonomy.pose_estimator.pose is not None, 10.0)

    def until(self, done: Callable[[], bool], limit: float) -> None:
        end = self.now + limit
        while not done() and self.now < end:
            self.now += TICK
            self.anna.last_heard = self.now
            self.station.step(self.now)

    def wait(self, seconds: float) -> None:
        self.until(lambda: False, seconds)

    def ask(self, name: str, request: CommandRequest) -> None:
        answer = self.door.call(self.anna, name, request)
        assert answer.success, answer.message  # type: ignore[union-attr]

    def patrol(self, points: list[Waypoint], **words: object) -> None:
        mission = Mission(waypoints=points, **{"laps": 1, "home": [HOME], **words})  # type: ignore[arg-type]
        self.ask("/mission/set", SetMissionRequest(mission=mission))
        self.ask("/task/start", StartTaskRequest())

    def order(self, task: str, *places: str, **words: object) -> None:
        self.ask("/task/start", StartTaskRequest(order=TaskOrder(task=task, places=list(places), **words)))  # type: ignore[arg-type]

    def tell(self, topic: str, msg: Msg) -> None:
        """As if the robot had measured it."""
        self.station.autonomy.on_message(topic, msg, self.now)

    @property
    def task(self) -> TaskStatus:
        return self.station.autonomy.engine.status

    def finish(self, limit: float = 400.0) -> list[tuple[float, float]]:
        """Where the robot truly was, up to the end of the task."""
        trail = []
        end = self.now + limit
        while self.station.autonomy.engine.running and self.now < end:
            self.wait(0.1)
            trail.append(self.place)
        return trail

    @property
    def place(self) -> tuple[float, float]:
        x, y, _ = self.robot.simulation.pose()
        return x, y

    @property
    def error(self) -> float:
        """Of the believed position [m]."""
        pose = self.station.autonomy.pose_estimator.pose
        return pose.distance(*self.place) if pose else math.inf
