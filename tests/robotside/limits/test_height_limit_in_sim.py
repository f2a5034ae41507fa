"""Floor and ceiling on the simulated drone and swimmer, measured against the truth under a wild stick."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.config import Config, LimitSettings
from robotside.station.station import Station
from sim.robot import make
from tests.fakes import FakeClient
from tests.robotside.scene import records_at

pytestmark = pytest.mark.slow

TICK = 1 / 30
CASES = {
    "ardrone": (
        "parking_lot",
        LimitSettings(floor=1.5, ceiling=3.5),
        Manoeuvre(kind="take_off", height=2.5),
        1.0,
    ),
    "aqua": ("tank", LimitSettings(floor=-2.5, ceiling=-1.0), Manoeuvre(kind="hover", height=-1.7), 0.3),
}
OVER = 0.1
"""By so much it may overshoot [m]."""


@pytest.mark.parametrize("name", CASES)
def test_a_wild_stick_never_gets_it_past_floor_or_ceiling(name: str, tmp_path: Path) -> None:
    world, limits, begins, climb = CASES[name]
    robot = make(name, world, seed=3, camera=False)
    now, rng, anna = 1000.0, random.Random(5), FakeClient("anna", 1000.0)
    station = Station(
        robot,
        records_at(tmp_path),
        now=now,
        clock=lambda: now,
        rng=rng,
        config=Config(limits=limits),
    )

    def height() -> float:
        return robot.simulation.vehicle.state().position[2]

    try:
        robot.manoeuvre(begins)
        for _ in range(round(12.0 / TICK)):
            now += TICK
            station.step(now)
        heights, wanted, until = [], Twist(), 0.0
        for step in range(round(45.0 / TICK)):
            now += TICK
            anna.last_heard = now
            if now > until:
                wanted = Twist(Vector3(rng.choice([0.0, 0.4]), 0.0, rng.choice([climb, -climb])))
                until = now + rng.uniform(1.0, 7.0)
            if step % 3 == 0:
                station.on_message(anna, "/cmd_vel", wanted, None)
            station.step(now)
            heights.append(height())
    finally:
        station.close()
    low, high = limits.lowest, limits.highest
    assert min(heights) > low - OVER
    assert max(heights) < high + OVER
    assert min(heights) < low + 0.25, "it was driven down to the floor"
    assert max(heights) > high - 0.25, "it was driven up to the ceiling"
