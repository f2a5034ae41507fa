"""A simulated robot with its station and somebody's hand at its controls, in virtual time."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from pathlib import Path

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import CommandRequest, CommandResponse, Event, Manoeuvre
from robotside.control.stop_release import MIN_HOLD_TIME
from robotside.core.config import DEFAULT_CONFIG, Config
from robotside.door.station_door import StationDoor
from robotside.motion.manoeuvres import Order
from robotside.station.station import Station
from sim.physics.backend_bullet import State
from sim.robot import make
from tests.fakes import FakeClient
from tests.robotside.scene import records_at

__all__ = ["UPSIDE_DOWN", "Hand", "steer", "tilt"]

TICK = 1 / 30
WORLDS = {"minnow": "lake", "aqua": "tank"}
UPSIDE_DOWN = (1.0, 0.0, 0.0, 0.0)


def tilt(z: float = 0.0, turn: float = 0.0, **words: float) -> Manoeuvre:
    """Lean by `roll` and `pitch` [rad], climb by `z` [m/s]."""
    return Manoeuvre(kind="tilt", twist=Twist(Vector3(0.0, 0.0, z), Vector3(0.0, 0.0, turn)), **words)  # type: ignore[arg-type]


def steer(steering: float, **words: float) -> Manoeuvre:
    """Steer by an angle [rad] at a `speed` or a `throttle`."""
    return Manoeuvre(kind="steer", steering=steering, **words)  # type: ignore[arg-type]


class Hand:
    """Anna's controls, and what becomes of the robot."""

    def __init__(
        self, name: str, state: Path, config: Config = DEFAULT_CONFIG, *, payloads: Sequence[str] = ()
    ) -> None:
        self.robot = make(name, WORLDS.get(name, "parking_lot"), seed=2, camera=False, payloads=payloads)
        self.now = 1000.0
        self.anna = FakeClient("anna", self.now)
        self._pushed = math.inf
        self.station = Station(
            self.robot,
            records_at(state),
            now=self.now,
            clock=lambda: self.now,
            rng=random.Random(1),
            config=config,
        )
        self.events: list[str] = []
        self.station.bus.subscribe("/events", lambda _, msg: self._hear(msg))
        self.door = StationDoor(self.station)
        self.wait(3.2)

    def _hear(self, msg: object) -> None:
        assert isinstance(msg, Event)
        self.events.append(msg.text)

    def wait(self, seconds: float, *, heard: bool = True) -> None:
        """Nobody touches anything; with `heard` False nothing is heard of anybody either."""
        for _ in range(round(seconds / TICK)):
            self.now += TICK
            if heard:
                self.anna.last_heard = self.now
            self.station.step(self.now)

    def lift(self, height: float = 1.0) -> None:
        """It is in the air already, whoever took off; where it stood, it hovers `height` above the map's origin [m]."""
        self.robot.manoeuvre(Manoeuvre(kind="take_off", height=height))
        self.wait(2.5)

    def push(self, order: Order, seconds: float, *, from_rest: bool = True) -> None:
        """Hold the controls there, coming from rest unless they were held already."""
        topic = "/cmd_manoeuvre" if isinstance(order, Manoeuvre) else "/cmd_vel"
        if from_rest and self.now - self._pushed > 0.2:
            self.station.on_message(self.anna, "/cmd_vel", Twist(), None)
        for _ in range(round(seconds / 0.1)):
            self.station.on_message(self.anna, topic, order, None)
            self._pushed = self.now
            self.wait(0.1)

    def ask(
        self, service: str, request: CommandRequest | None = None, by: FakeClient | None = None
    ) -> CommandResponse:
        answer = self.door.call(by or self.anna, service, request or CommandRequest())
        assert isinstance(answer, CommandResponse)
        return answer

    def release_stop(self) -> CommandResponse:
        """Release STOP as a finger does, by a hold of a second."""
        assert self.ask("/stop/hold").success
        self.wait(MIN_HOLD_TIME + 0.1)
        return self.ask("/stop/release")

    @property
    def state(self) -> State:
        return self.robot.simulation.vehicle.state()

    @property
    def height(self) -> float:
        return self.state.position[2]

    @property
    def speed(self) -> float:
        return math.hypot(*self.state.velocity)

    @property
    def yaw(self) -> float:
        return self.robot.simulation.pose()[2]

    @property
    def error(self) -> float:
        """Of the believed position [m]."""
        pose = self.station.autonomy.pose_estimator.pose
        x, y, _ = self.state.position
        return pose.distance(x, y) if pose else math.inf

    def close(self) -> None:
        self.robot.close()
