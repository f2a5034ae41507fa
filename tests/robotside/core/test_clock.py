"""The robot's clock beside real time."""

from __future__ import annotations

import pytest

from robotside.core.clock import MAX_STEP, MAX_TICK, RobotClock


def test_the_robots_clock_follows_real_time_at_its_speed() -> None:
    clock = RobotClock(100.0, speed=4.0)
    assert clock.tick(100.1) == pytest.approx(100.4)
    assert clock.tick(100.2) == pytest.approx(100.8)


def test_after_a_long_halt_little_is_made_good_at_once_and_the_rest_slowly() -> None:
    clock = RobotClock(100.0)
    assert clock.tick(110.0) - 100.0 <= MAX_TICK * 1.1 + 1e-9
    before = clock.now
    assert clock.tick(110.1) - before == pytest.approx(0.11)
    for tick in range(2000):
        clock.tick(110.1 + tick * 0.1)
    assert clock.now == pytest.approx(110.1 + 199.9)


def test_the_robots_clock_never_goes_back() -> None:
    clock = RobotClock(100.0)
    clock.tick(101.0)
    now = clock.now
    assert clock.tick(90.0) == now
    assert clock.tick(101.0) == now


def test_a_fast_clock_goes_in_steps_short_enough_to_steer() -> None:
    clock = RobotClock(100.0, speed=20.0)
    steps = clock.steps(100.1)
    assert steps[-1] == clock.now == pytest.approx(102.0)
    gaps = [b - a for a, b in zip([100.0, *steps], steps, strict=False)]
    assert 0.0 < max(gaps) <= MAX_STEP + 1e-9
    assert clock.steps(100.1) == []


def test_a_clock_in_real_time_goes_in_one_step_per_tick() -> None:
    clock = RobotClock(100.0)
    assert clock.steps(100.0 + 1 / 60) == [pytest.approx(100.0 + 1 / 60)]


def test_the_real_time_of_a_picture_is_known_at_any_speed() -> None:
    clock = RobotClock(100.0, speed=4.0)
    clock.tick(100.1)
    assert clock.real(clock.now) == pytest.approx(100.1)
    assert clock.real(clock.now - 0.2) == pytest.approx(100.05)


def test_the_real_time_of_a_picture_is_right_after_a_halt_that_left_the_robots_clock_behind() -> None:
    clock = RobotClock(100.0)
    clock.tick(130.0)
    assert clock.now < 101.0
    assert clock.real(clock.now) == pytest.approx(130.0)


def test_between_two_ticks_the_robots_clock_is_known_too() -> None:
    clock = RobotClock(100.0, speed=4.0)
    clock.tick(100.1)
    assert clock.at(100.15) == pytest.approx(100.6)
    assert clock.real(clock.at(100.15)) == pytest.approx(100.15)
