"""The part of a position's uncertainty that its filter cannot see: an error that all fixes share, and dead reckoning.

Pure. A robot that sees walls has none of it.
"""

from __future__ import annotations

import math

__all__ = ["PositionUncertainty"]


class PositionUncertainty:
    """Variances of a place, along each axis [m2]."""

    def __init__(self) -> None:
        self._known = self._reckoned = self._since = 0.0
        self._sees = False

    @property
    def variance(self) -> float:
        """To be added to what the filter says [m2]."""
        return 0.0 if self._sees else self._known + self._reckoned - self._since

    def reckon(self, variance: float) -> None:
        """Odometry says that it is off by this since it began [m2]; what is no number changes nothing."""
        if not math.isfinite(variance):
            return
        if variance < self._reckoned:  # it began anew
            self._known, self._since = self._known + self._reckoned - self._since, variance
        self._reckoned = variance

    def fix(self, variance: float) -> None:
        """A fix came that may be off by this, and the next ones with it [m2]: they err together for minutes."""
        self._known, self._since = variance, self._reckoned

    def settle(self) -> None:
        """An operator has set its place."""
        self.fix(0.0)

    def on_walls_seen(self) -> None:
        """It sees walls that are on its map, by which the filter goes from now on."""
        self._sees = True

    def on_walls_gone(self) -> None:
        """It sees too little to go by; what satellites and wheels say counts."""
        self._sees = False
