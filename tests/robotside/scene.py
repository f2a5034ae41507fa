"""A station in virtual time, for the tests of what happens in it."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Point, Pose, PoseStamped, Quaternion, Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    ControlStatus,
    Event,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    TaskStatus,
    Waypoint,
)
from robotside.control.stop_release import MIN_HOLD_TIME
from robotside.core.config import DEFAULT_CONFIG, Config
from robotside.core.worker import Worker
from robotside.door.station_door import StationDoor
from robotside.records import Records
from robotside.records.database.rows import Content, empty
from robotside.station.station import Station
from tests.fakes import FakeClient, FakeRobot

__all__ = ["SQUARE", "Scene", "records_at"]

TICK = 1 / 60
SQUARE = [Waypoint(4.0, 0.0), Waypoint(4.0, 3.0), Waypoint(-2.0, 3.0)]


_KEPT: dict[Path, Content] = {}


def records_at(state: Path) -> Records:
    """What is kept in the memory of this process under a path: the same for every start of a robot side there."""
    return Records.in_memory(_KEPT.setdefault(state, empty() | {"facts": {"log": "b1"}}))


class Scene:
    """A station on a fake robot, with its messages recorded and time in hand.

    `now` is the robot's clock, which runs `speed` times as fast as the operators', `clock`.
    """

    def __init__(
        self,
        robot: FakeRobot,
        state: Path,
        speed: float = 1.0,
        config: Config = DEFAULT_CONFIG,
        *,
        civil: Callable[[], float] | None = None,
        worker: Worker | None = None,
    ) -> None:
        self.now = self.clock = 1000.0
        self._speed = speed
        self.robot = robot
        self.clients: list[FakeClient] = []
        self.anna = self.client("anna")
        records = records_at(state)
        self._known = max((event.id for event in records.events.since(0, "")), default=0)
        self.station = Station(
            robot,
            records,
            now=self.now,
            clock=lambda: self.clock,
            rng=random.Random(1),
            config=config,
            civil=civil,
            worker=worker,
        )
        self.said: list[tuple[str, Msg]] = []
        self.station.bus.subscribe(None, lambda topic, msg: self.said.append((topic, msg)))
        self.door = StationDoor(self.station)
        self.hear = self.door.publish

    def client(self, name: str) -> FakeClient:
        client = FakeClient(name, self.clock)
        self.clients.append(client)
        return client

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK)):
            self.now += TICK
            self.clock += TICK / self._speed
            for client in self.clients:
                client.last_heard = self.clock
            self.station.step(self.now)

    def until(self, done: Callable[[], bool], limit: float) -> None:
        """Let time pass until it is so; fails when it is not within `limit` [s]."""
        end = self.now + limit
        while not done():
            assert self.now < end, f"not so within {limit:g} s"
            self.run(0.1)

    def run_task(self, limit: float = 200.0) -> TaskStatus:
        end = self.now + limit
        while self.station.autonomy.engine.running and self.now < end:
            self.run(0.1)
        return self.station.autonomy.engine.status

    def ask(self, name: str, request: Msg | None = None, client: FakeClient | None = None) -> CommandResponse:
        answer = self.door.call(client or self.anna, name, request or CommandRequest())
        assert isinstance(answer, Msg)
        return answer  # type: ignore[return-value]

    def refused(self, name: str, request: Msg | None = None, client: FakeClient | None = None) -> str:
        answer = self.ask(name, request, client)
        assert not answer.success
        return answer.message

    def release_stop(self, client: FakeClient | None = None, request: Msg | None = None) -> CommandResponse:
        """Release STOP as a finger does, by a hold of a second; the answer at its end, or to its beginning if that is refused."""
        begun = self.ask("/stop/hold", request, client)
        if not begun.success:
            return begun
        self.run(MIN_HOLD_TIME + 0.05)
        return self.ask("/stop/release", request, client)

    def set(self, *points: Waypoint, **words: object) -> None:
        home = words.pop("home", [Waypoint(0.0, 0.0)])
        mission = Mission(waypoints=list(points), home=home, **words)  # type: ignore[arg-type]
        answer = self.ask("/mission/set", SetMissionRequest(mission=mission))
        assert answer.success, answer.message

    def start(self) -> None:
        answer = self.ask("/task/start", StartTaskRequest())
        assert answer.success, answer.message

    def drive(self, twist: Twist, client: FakeClient | None = None, stamp: float | None = None) -> None:
        self.hear(client or self.anna, "/cmd_vel", twist, stamp)

    def go_to(self, x: float, y: float, yaw: float = 0.0, client: FakeClient | None = None) -> None:
        goal = PoseStamped(pose=Pose(Point(x, y), Quaternion.from_yaw(yaw)))
        self.hear(client or self.anna, "/goal_pose", goal, None)

    def events(self, kind: str = "") -> list[str]:
        return [msg.text for _, msg in self.said if isinstance(msg, Event) and (not kind or msg.kind == kind)]

    def since_start(self) -> list[str]:
        """Everything that was said since this robot side was started."""
        return [event.text for event in self.station.events.since(0, "b1") if event.id > self._known]

    def of(self, topic: str) -> list[Msg]:
        return [msg for name, msg in self.said if name == topic]

    @property
    def task(self) -> TaskStatus:
        return self.station.autonomy.engine.status

    @property
    def control(self) -> ControlStatus:
        last = self.station.bus.last("/control/status")
        assert isinstance(last, ControlStatus)
        return last
