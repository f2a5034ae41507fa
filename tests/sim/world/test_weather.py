"""Waves, current and gusts as they are at each moment."""

from __future__ import annotations

import math
import statistics

import pytest

from sim.core.constants import GRAVITY, STEPS_PER_SECOND
from sim.core.noise import Noise
from sim.world.weather import Weather
from tests.sim.rooms import plain

WAVES = "[water]\ndepth = 9.0\ncurrent = [0.1, -0.2]\n[[water.waves]]\nheight = 0.4\nperiod = 2.0\ndirection = 90\n"
GUSTS = "[wind]\nspeed = 3.0\ndirection = 90\ngusts = 1.0\ngust_time = 0.5\n"


def weather(text, *, noise=True):
    return Weather(plain(text), Noise(1, "gusts", on=noise))


def after(now, seconds):
    for _ in range(round(seconds * STEPS_PER_SECOND)):
        now.step()
    return now


def test_a_wave_comes_again_after_its_period_and_its_length():
    now = weather(WAVES)
    length = GRAVITY * 2.0**2 / math.tau
    crest = now.surface(0.0, 0.0)
    assert crest == pytest.approx(0.2)
    assert now.surface(0.0, length) == pytest.approx(crest)
    assert now.surface(0.0, length / 2) == pytest.approx(-crest)
    assert now.surface(5.0, 0.0) == pytest.approx(crest)
    assert after(now, 1.0).surface(0.0, 0.0) == pytest.approx(-crest)
    assert after(now, 1.0).surface(0.0, 0.0) == pytest.approx(crest)


def test_a_wave_runs_where_it_is_told():
    assert after(weather(WAVES), 0.5).surface(0.0, GRAVITY * 4 / math.tau / 4) == pytest.approx(0.2)


def test_waves_add_up():
    both = weather(WAVES + "[[water.waves]]\nheight = 0.2\nperiod = 1.0\nphase = 180\n")
    assert both.surface(0.0, 0.0) == pytest.approx(0.2 - 0.1)


def test_the_current_and_the_density_are_those_of_the_world():
    now = weather(WAVES)
    assert (now.wet, now.density, now.current) == (True, 1000.0, (0.1, -0.2, 0.0))
    assert weather("").wet is False


def test_gusts_come_and_go_round_the_wind_as_strongly_as_told_and_half_as_much_upward():
    now, winds = weather(GUSTS), []
    for _ in range(120 * STEPS_PER_SECOND):
        now.step()
        winds.append(now.wind)
    x, y, z = zip(*winds[::24], strict=True)
    assert (statistics.mean(x), statistics.mean(y)) == pytest.approx((0.0, 3.0), abs=0.35)
    assert statistics.stdev(x) == pytest.approx(1.0, abs=0.2)
    assert statistics.stdev(y) == pytest.approx(1.0, abs=0.2)
    assert statistics.stdev(z) == pytest.approx(0.5, abs=0.1)


def test_without_noise_the_wind_is_steady():
    assert after(weather(GUSTS, noise=False), 1.0).wind == pytest.approx((0.0, 3.0, 0.0))
