"""What the hand feels: patterns that differ without looking, for what was understood, for STOP and for what is refused."""

from __future__ import annotations

import logging
from typing import Final, NamedTuple

from app.device import is_android

__all__ = ["DONE", "REFUSED", "STEP", "STOPS", "UNDERSTOOD", "Pattern", "vibrate"]

log = logging.getLogger(__name__)

WAVEFORMS_SINCE = 26
"""Android's version that has `VibrationEffect` (8.0)."""
MAX_TIME = 2000
"""Longer is no signal but a nuisance [ms]."""


class Pattern(NamedTuple):
    """Turns of rest and vibration."""

    times: tuple[int, ...]
    """A rest, a vibration, a rest, … [ms]; the first rest may be 0."""

    @property
    def length(self) -> int:
        """From its begin to its end [ms]."""
        return sum(self.times)


STEP: Final = Pattern((0, 20))
"""A mark went one further."""
UNDERSTOOD: Final = Pattern((0, 80))
"""A gesture or a word was understood."""
DONE: Final = Pattern((0, 120))
"""A part of a lesson is done, or a shake was understood."""
STOPS: Final = Pattern((0, 400, 80, 400))
"""STOP: twice and long, as nothing else."""
REFUSED: Final = Pattern((0, 60, 60, 60, 60, 60))
"""It was understood and is not done: three short ones."""


def vibrate(pattern: Pattern) -> bool:
    """Have the hand feel it; False, and nothing happens, where nothing can vibrate."""
    if not is_android() or pattern.length > MAX_TIME:
        return False
    try:
        return _of_android(pattern)
    except Exception as problem:  # noqa: BLE001 - whatever a phone answers, what was understood goes on
        log.warning("The phone does not vibrate: %s", problem)
        return False


def _of_android(pattern: Pattern) -> bool:
    from jnius import autoclass

    activity = autoclass("org.kivy.android.PythonActivity").mActivity
    motor = activity.getSystemService(autoclass("android.content.Context").VIBRATOR_SERVICE)
    if motor is None or not motor.hasVibrator():
        return False
    times = list(pattern.times)
    if autoclass("android.os.Build$VERSION").SDK_INT >= WAVEFORMS_SINCE:
        motor.vibrate(autoclass("android.os.VibrationEffect").createWaveform(times, -1))
    else:
        motor.vibrate(times, -1)
    return True
