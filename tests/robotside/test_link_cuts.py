"""Three hundred links that are cut at random instants while a robot is driven at full speed, over all kinds, in virtual time."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import msgspec
import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.control.command_expiry import HOLD_TIME, MAX_UNSTAMPED_AGE, VALID_TIME
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.scene import Scene

CUTS = 60
"""Of each kind."""
TICK = 1 / 60
PERIOD = 1 / 20
"""Between two commands of a stick [s]."""
SPARE = 0.03
"""For a computer that is busy: what its scheduling may add in real time [s]."""
FULL = Twist.planar(0.7, 1.2)


class Noting(FakeRobot):
    """Notes when it was told to move and when to rest; turning and going up and down are not driving."""

    def __init__(self, kind: str) -> None:
        super().__init__(beams=4)
        self.info = msgspec.structs.replace(self.info, kind=kind)
        self.silent = {"/scan"}
        self.moving = False

    def drive(self, twist: Twist) -> None:
        super().drive(twist)
        self.moving = math.hypot(twist.linear.x, twist.linear.y) > 0

    def stop(self) -> None:
        super().stop()
        self.moving = False


@dataclass(frozen=True)
class Cut:
    """One drive and how its link ends."""

    how: str
    """lost: nothing comes any more; closed: the socket is; stalled: all comes later, in one breath; slowing: each takes
    longer than the one before."""
    stamped: bool
    after: float
    """How long it is driven [s]."""
    way: float
    """From the finger to the robot [s], with as much again by chance."""
    stall: float

    @classmethod
    def some(cls, rng: random.Random) -> Cut:
        return cls(
            how=rng.choice(["lost", "closed", "stalled", "slowing"]),
            stamped=rng.random() < 0.7,
            after=rng.uniform(0.1, 0.9),
            way=rng.uniform(0.0, 0.06),
            stall=rng.uniform(0.35, 1.5),
        )

    def arrivals(self, start: float, rng: random.Random) -> Iterator[tuple[float, float]]:
        """When each command comes and when it was given, in order."""
        last, given, more = start, start, rng.uniform(0.2, 0.8) if self.how == "slowing" else 0.0
        while given < start + self.after + (1.0 if self.how == "stalled" else 0.0):
            last = max(last, given + self.way * (1 + rng.random()) + more * (given - start))
            cut = start + self.after
            if last < cut:
                yield last, given
            elif self.how == "stalled":
                yield max(last, cut + self.stall), given
            given += PERIOD


class Trial:
    """One scene in which one cut comes after the other."""

    def __init__(self, kind: str, state: Path) -> None:
        self.robot = Noting(kind)
        self.scene = Scene(self.robot, state)
        self.scene.run(0.5)
        self.worst = 0.0
        """From the last valid command to rest [s]."""

    def drive(self, cut: Cut, rng: random.Random) -> None:
        scene = self.scene
        client = scene.client("phone")
        start = scene.clock
        self.robot.pose = (0.0, 0.0, 0.0)
        scene.drive(Twist(), client, None)  # the hand before went with its stick pushed
        end = start + cut.after
        valid, moved = -math.inf, False
        for moment, given in (*cut.arrivals(start, rng), (end + 2.0, math.nan)):
            valid = self._pass(client, cut, end, moment, valid)
            if math.isnan(given):
                break
            client.answered = min(moment, end) - 2 * cut.way - 0.2
            before = len(self.robot.commands)
            scene.drive(FULL, client, given if cut.stamped else None)
            if len(self.robot.commands) > before and self.robot.moving:
                assert moment - given <= (HOLD_TIME if cut.stamped else MAX_UNSTAMPED_AGE)
                valid, moved = (given if cut.stamped else moment), True
        assert moved
        assert not self.robot.moving
        scene.station.on_gone(client)
        scene.clients.clear()

    def _pass(self, client: FakeClient, cut: Cut, end: float, until: float, valid: float) -> float:
        """Let time pass, tick by tick; the robot rests in time."""
        scene, closed = self.scene, cut.how != "closed"
        while scene.clock < until:
            step, moved = min(TICK, until - scene.clock), self.robot.moving
            scene.now += step
            scene.clock += step
            if scene.clock < end:
                client.last_heard = scene.clock
            elif not closed:
                scene.station.on_gone(client)
                closed = True
            if step == TICK or scene.clock >= until:
                scene.station.step(scene.now)
            if moved:  # until now at least
                self.worst = max(self.worst, scene.clock - valid)
                assert scene.clock - valid <= VALID_TIME, (cut, scene.clock - valid)
        return valid


@pytest.mark.parametrize("ahead", [0.0, 0.1, 0.9])
def test_a_clock_that_is_ahead_and_then_silence_is_zero_as_soon(tmp_path: Path, ahead: float) -> None:
    way, robot = 0.08, Noting("wheels")
    scene = Scene(robot, tmp_path)
    scene.run(0.5)
    scene.anna.rtt = 2 * way
    for _ in range(6):
        given = scene.clock
        scene.run(way)
        scene.drive(FULL, stamp=given + ahead)
        assert robot.moving
    scene.run(given + VALID_TIME - SPARE - scene.clock)
    assert not robot.moving


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["wheels", "ackermann", "boat", "hexapod", "quadrotor"])
def test_the_commanded_speed_is_zero_300_ms_after_the_last_valid_command(kind: str, tmp_path: Path) -> None:
    rng, trial = random.Random(f"cuts of {kind}"), Trial(kind, tmp_path)
    for _ in range(CUTS):
        trial.drive(Cut.some(rng), rng)
    assert 0.2 < trial.worst <= VALID_TIME - SPARE
