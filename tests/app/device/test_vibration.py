"""What the hand feels, as Android's own classes would be called."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from app.device import vibration as module
from app.device.vibration import DONE, REFUSED, STEP, STOPS, UNDERSTOOD, Pattern, vibrate
from tests.app.device.java import Handle, JavaException, install, java

EVERY = (STEP, UNDERSTOOD, DONE, STOPS, REFUSED)


class Phone:
    """Its motor, and what it was told to do."""

    def __init__(
        self, monkeypatch: pytest.MonkeyPatch, version: int = 34, *, motor: bool = True, service: bool = True
    ) -> None:
        self.felt: list[Any] = []
        self.problem = ""
        vibrator = java("android.os.Vibrator", hasVibrator=motor, vibrate=self._vibrate)
        activity = java("android.app.Activity", getSystemService=lambda _: vibrator if service else None)
        install(
            monkeypatch,
            java("org.kivy.android.PythonActivity", mActivity=activity),
            java("android.os.Build$VERSION", SDK_INT=version),
            java(
                "android.os.VibrationEffect", createWaveform=lambda times, repeat: Handle(f"{times} {repeat}")
            ),
        )
        monkeypatch.setattr(module, "is_android", lambda: True)

    def _vibrate(self, *given: Any) -> None:
        if self.problem:
            raise JavaException(self.problem)
        self.felt.append(given)


def test_a_pattern_is_felt_once(monkeypatch: pytest.MonkeyPatch) -> None:
    phone = Phone(monkeypatch)
    assert vibrate(STOPS)
    assert phone.felt == [("[0, 400, 80, 400] -1",)]


def test_before_android_8_it_is_told_as_plain_times(monkeypatch: pytest.MonkeyPatch) -> None:
    phone = Phone(monkeypatch, version=25)
    assert vibrate(REFUSED)
    assert phone.felt == [([0, 60, 60, 60, 60, 60], -1)]


@pytest.mark.parametrize("lacks", ["motor", "service"])
def test_a_device_that_cannot_vibrate_feels_nothing(monkeypatch: pytest.MonkeyPatch, lacks: str) -> None:
    phone = Phone(monkeypatch, **{lacks: False})
    assert not vibrate(STEP)
    assert not phone.felt


def test_a_phone_that_refuses_is_logged_and_nothing_else_happens(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    phone = Phone(monkeypatch)
    phone.problem = "no permission"
    assert not vibrate(STEP)
    assert "does not vibrate: no permission" in caplog.text


def test_nobody_is_annoyed_for_longer_than_two_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    phone = Phone(monkeypatch)
    assert not vibrate(Pattern((0, 2001)))
    assert not phone.felt
    assert all(one.length <= module.MAX_TIME for one in EVERY)


def test_on_a_computer_nothing_is_felt() -> None:
    assert not vibrate(STOPS)


def test_patterns_are_told_apart_without_looking() -> None:
    """By their number of pulses, or by a length that differs by a third at the least."""
    for one, other in itertools.combinations(EVERY, 2):
        pulses = len(one.times) // 2, len(other.times) // 2
        assert pulses[0] != pulses[1] or max(one.length, other.length) >= 1.33 * min(one.length, other.length)
    assert STOPS.length > max(one.length for one in EVERY if one is not STOPS)
