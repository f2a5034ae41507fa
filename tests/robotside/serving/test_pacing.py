"""The loop under a simulation that is slower than real time: data stay fresh, and it is known how slow it is."""

from __future__ import annotations

import pytest

from robotside.core.clock import MAX_LAG, MAX_STEP, MAX_TICK, RobotClock
from robotside.serving.pacing import Pacing

TICK = 1 / 60


class Loop:
    """A loop in virtual time whose robots take `cost` [s] of real time for each second of theirs."""

    def __init__(self, cost: float, speed: float = 1.0) -> None:
        self.wall = 100.0
        self.cost = cost
        self.clock = RobotClock(self.wall, speed)
        self.pace = Pacing(self.clock, lambda: self.wall)
        self.simulated = self.given_up = 0.0
        self.oldest = 0.0
        """Of all data, when they were made [s, real time]."""

    def run(self, seconds: float) -> None:
        end = self.wall + seconds
        while self.wall < end:
            began = self.wall
            self.given_up += self.pace.begin()
            before = self.clock.now
            for now in self.pace.steps():
                self.wall += (now - before) * self.cost
                self.simulated += now - before
                before = now
                self.oldest = max(self.oldest, self.clock.lag(self.wall) if now == self.clock.now else 0.0)
            self.oldest = max(self.oldest, self.clock.lag(self.wall))
            self.wall = max(self.wall, began + TICK)


@pytest.mark.parametrize("factor", [0.05, 0.14, 0.4, 0.8])
def test_data_of_a_slow_simulation_never_get_old_and_its_factor_is_measured(factor: float) -> None:
    loop = Loop(1 / factor)
    loop.run(30.0)
    assert loop.oldest < MAX_LAG + MAX_TICK + MAX_STEP / factor
    assert loop.pace.timing.factor == pytest.approx(factor, rel=0.05)
    assert loop.simulated == pytest.approx(30.0 * factor, rel=0.05)
    assert loop.simulated + loop.given_up == pytest.approx(30.0, abs=2.0)


def test_a_simulation_that_keeps_up_gives_nothing_up() -> None:
    loop = Loop(0.05)
    loop.run(10.0)
    assert (loop.given_up, loop.pace.timing.factor) == (0.0, pytest.approx(1.0, abs=0.02))
    assert loop.pace.timing.lag < 0.05


def test_one_halt_is_no_lag_and_is_given_up() -> None:
    loop = Loop(0.05)
    loop.run(5.0)
    loop.wall += 3.0
    loop.run(0.5)
    assert loop.pace.timing.factor == pytest.approx(1.0, abs=0.15)
    assert loop.given_up == pytest.approx(2.9, abs=0.1)
    assert loop.clock.lag(loop.wall) < MAX_LAG


def test_a_fast_simulation_is_measured_by_real_time() -> None:
    loop = Loop(0.5, speed=4.0)
    loop.run(10.0)
    assert loop.pace.timing.factor == pytest.approx(2.0, rel=0.05)


def test_one_that_is_fast_again_is_so_within_seconds() -> None:
    loop = Loop(7.0)
    loop.run(10.0)
    loop.cost = 0.05
    loop.run(5.0)
    assert loop.pace.timing.factor == pytest.approx(1.0, abs=0.1)
    assert loop.clock.lag(loop.wall) < 0.05
