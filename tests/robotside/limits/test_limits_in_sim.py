"""The fence on the simulated robot, measured against the truth: a wild stick, and cuts of the link at random moments."""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Twist
from robotside.core.config import Config, LimitSettings
from robotside.limits.fence import Fence
from robotside.station.station import Station
from sim.robot import SimRobot, make
from tests.fakes import FakeClient
from tests.robotside.scene import records_at

pytestmark = pytest.mark.slow

TICK = 1 / 60
PAD = ((-19.0, -14.0), (-15.0, -14.0), (-15.0, -9.0), (-19.0, -9.0))
KERB = ((-16.6, -12.5), (-16.0, -12.5), (-16.0, -11.0), (-16.6, -11.0))
"""Round where the robot of the parking lot starts."""


@pytest.fixture
def robot() -> Iterator[SimRobot]:
    robot = make("patrol", "parking_lot", seed=3, camera=False)
    yield robot
    robot.close()


def test_a_wild_stick_never_gets_the_body_over_the_fence(robot: SimRobot, tmp_path: Path) -> None:
    now, rng, fence = 1000.0, random.Random(5), Fence([PAD], [KERB])
    config = Config(limits=LimitSettings(keep_in=(PAD,), keep_out=(KERB,)))
    anna = FakeClient("anna", now)
    station = Station(robot, records_at(tmp_path), now=now, clock=lambda: now, rng=rng, config=config)
    rooms, wanted, until, silent, pushed = [], Twist(), 0.0, 0.0, 0.0
    for step in range(60 * 60):
        now += TICK
        anna.last_heard = now
        if now > until:
            turn = rng.choice([0.0, 0.0, 1.5, -1.5, 0.4])
            wanted = Twist.planar(rng.choice([0.7, 0.7, -0.7, 0.3]), turn)
            until, silent = now + rng.uniform(0.3, 4.0), rng.choice([0.0, 0.0, 1.0])
        if step % 6 == 0 and now < until - silent:
            if now - pushed > 0.2:
                station.on_message(anna, "/cmd_vel", Twist(), None)
            pushed = now
            station.on_message(anna, "/cmd_vel", wanted, None)
        station.step(now)
        x, y, _ = robot.simulation.pose()
        rooms.append(float(fence.clearance(np.array([[x, y]]))[0]) - robot.info.radius)
    assert min(rooms) > 0.0
    assert sum(room < 0.2 for room in rooms) > 300
    assert station.autonomy.pose_estimator.odometer > 5.0
