"""Sensors of a phone, as Android's own classes would be called, and one that is made up."""

from __future__ import annotations

import itertools
import math
import sys
from types import SimpleNamespace
from typing import Any

import pytest

from app.device import motion
from app.device.motion import (
    GRAVITY,
    AndroidMotion,
    MotionError,
    NoMotion,
    OurClock,
    SimulatedMotion,
    leaned,
    motion_source,
    up_of,
)
from tests.app.device.java import install, java


class Service:
    """Android's SensorManager, with the types of sensors that it has."""

    def __init__(self, *types: int) -> None:
        self.types, self.listeners, self.unwilling = types, [], 0
        """Type of the one that is not handed out; 0 for none."""
        self.rates: list[int] = []

    def getDefaultSensor(self, kind: int) -> Any:
        return java("android.hardware.Sensor", getType=kind) if kind in self.types else None

    def registerListener(self, listener: Any, sensor: Any, rate: int) -> bool:
        if sensor.getType() == self.unwilling:
            return False
        self.listeners.append(listener)
        self.rates.append(rate)
        return True

    def unregisterListener(self, listener: Any) -> None:
        self.listeners.remove(listener)


@pytest.fixture
def phone(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Has the module `jnius` of a phone with such sensors."""

    def phone(*types: int) -> Service:
        service = Service(*types)
        manager = java(
            "android.hardware.SensorManager",
            getDefaultSensor=service.getDefaultSensor,
            registerListener=service.registerListener,
            unregisterListener=service.unregisterListener,
        )
        activity = java("android.app.Activity", getSystemService=lambda _: manager)
        install(monkeypatch, java("org.kivy.android.PythonActivity", mActivity=activity))
        return service

    return phone


def event(seconds: float, *values: float) -> Any:
    return SimpleNamespace(timestamp=int(seconds * 1e9), values=list(values))


def test_it_listens_at_the_rate_of_games_and_takes_every_listener_back(phone: Any) -> None:
    service = phone(1, 9)
    source = AndroidMotion(lambda: 5.0)
    source.start(("acceleration", "gravity"), lambda *_: None)
    assert service.rates == [1, 1]
    source.stop()
    assert service.listeners == []


def test_a_sample_comes_with_its_kind_and_our_time(phone: Any) -> None:
    service, got = phone(1, 9), []
    source = AndroidMotion(lambda: 5.0)
    source.start(("gravity",), lambda *told: got.append(told))
    service.listeners[0].onSensorChanged(event(900.0, 0.0, 1.0, 9.7))
    assert got == [("gravity", 5.0, (0.0, 1.0, 9.7))]


def test_without_a_gravity_sensor_the_rotation_vector_tells_it(phone: Any) -> None:
    service, got = phone(1, 15), []
    source = AndroidMotion(lambda: 5.0)
    source.start(("gravity",), lambda *told: got.append(told[2]))
    half = math.radians(15)
    service.listeners[0].onSensorChanged(event(1.0, math.sin(half), 0.0, 0.0, math.cos(half)))
    assert got[0] == pytest.approx((0.0, GRAVITY * math.sin(2 * half), GRAVITY * math.cos(2 * half)))
    assert up_of((math.sin(half), 0.0, 0.0)) == pytest.approx(got[0]), "older phones leave w out"


def test_a_phone_without_a_gyroscope_has_only_its_accelerometer(phone: Any) -> None:
    phone(1)
    assert AndroidMotion().kinds == {"acceleration"}


def test_a_phone_without_any_says_so(phone: Any) -> None:
    phone()
    source = AndroidMotion()
    assert not source.possible
    with pytest.raises(MotionError, match="no motion sensor"):
        source.start(("gravity",), lambda *_: None)


def test_a_refusal_takes_back_what_was_given(phone: Any) -> None:
    service = phone(1, 9)
    service.unwilling = 9
    with pytest.raises(MotionError, match="does not hand out its gravity sensor"):
        AndroidMotion().start(("acceleration", "gravity"), lambda *_: None)
    assert service.listeners == []


def test_a_sample_that_is_not_understood_never_reaches_java(phone: Any) -> None:
    service, told = phone(9), []
    AndroidMotion().start(("gravity",), lambda *sample: told.append(sample))
    service.listeners[0].onSensorChanged(event(1.0, 0.0))
    assert told == []
    service.listeners[0].onSensorChanged(event(1.0, 0.0, 0.0, 9.8))
    assert len(told) == 1, "the next one is told as ever"


def test_where_java_fails_there_is_no_sensor_and_the_reason(
    phone: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    phone(1)
    failure = sys.modules["jnius"].__dict__["JavaException"]("no such class")

    def fail(_: str) -> Any:
        raise failure

    monkeypatch.setattr(motion, "is_android", lambda: True)
    monkeypatch.setitem(sys.modules["jnius"].__dict__, "autoclass", fail)
    assert "no such class" in motion_source().sentence


def test_a_desktop_has_none() -> None:
    source = motion_source()
    assert isinstance(source, NoMotion)
    assert (source.possible, source.kinds) == (False, frozenset())
    with pytest.raises(MotionError, match="no motion sensor"):
        source.start(("gravity",), lambda *_: None)


def test_the_clock_of_a_sensor_is_fitted_to_the_quickest_way() -> None:
    now = [10.0]
    clock = OurClock(lambda: now[0])
    assert clock.of(500.0) == 10.0
    now[0] = 10.05
    assert clock.of(500.02) == pytest.approx(10.02), "this one was 30 ms on its way"
    now[0] = 10.06
    assert clock.of(500.08) == pytest.approx(10.06), "nothing comes before it was measured"
    now[0] = 20.0
    assert clock.of(700.0) == 20.0, "it was set anew"


def test_the_simulated_one_tells_what_is_due_and_is_never_the_same_twice() -> None:
    now, got = [0.0], []
    source = SimulatedMotion(now=lambda: now[0])
    source.start(("gravity",), lambda *told: got.append(told))
    source.tell()
    now[0] = 0.101
    source.lean(0.0, math.radians(30))
    source.tell()
    times, axes = [t for _, t, _ in got], [one for _, _, one in got[1:]]
    assert times == pytest.approx([0.0, 0.021, 0.041, 0.061, 0.081, 0.101])
    assert axes[0] == pytest.approx(leaned(0.0, math.radians(30)), abs=1e-3)
    assert all(one != other for one, other in itertools.pairwise(axes))
    now[0] = 60.0
    source.tell()
    assert len(got) == 6 + 25
    source.stop()
    source.tell()
    assert len(got) == 31
