"""The energy that the way takes, learnt from what the battery has lost on it."""

from __future__ import annotations

import math
from collections import deque

__all__ = ["EnergyUse"]

MIN_LOSS, MIN_WAY = 0.02, 20.0
"""From so much less charge, 0 to 1, over so much way on [m] it is known what a metre takes."""

DETOURS = 1.5
"""The way is longer than the straight line by so much at most, as a rule."""

RESERVE = 0.05
"""Left of the charge where it arrives, 0 to 1: for the approach and a second try."""


class EnergyUse:
    """What a metre takes, standing and computing on the way included."""

    def __init__(self) -> None:
        self._noted: deque[tuple[float, float]] = deque(maxlen=12)

    def note(self, charge: float, odometer: float, *, charging: bool) -> None:
        """The battery has `charge`, 0 to 1, after `odometer` [m]; while it is `charging` nothing is learnt."""
        if charging or math.isnan(charge):
            self._noted.clear()
        elif not self._noted or charge <= self._noted[-1][0] - 0.01:
            self._noted.append((charge, odometer))

    @property
    def per_metre(self) -> float:
        """Share of the charge for a metre; NaN while not known."""
        if not self._noted:
            return math.nan
        (charge, way), (now, here) = self._noted[0], self._noted[-1]
        lost, gone = charge - now, here - way
        return lost / gone if lost >= MIN_LOSS and gone >= MIN_WAY else math.nan

    def needed(self, distance: float) -> float:
        """The charge to set out with for a place `distance` [m] off in a straight line, 0 to 1; 0 while not known."""
        use = self.per_metre
        return 0.0 if math.isnan(use) or math.isnan(distance) else RESERVE + DETOURS * distance * use
