"""Faster and slower: steps of the greatest speed of the stick."""

from __future__ import annotations

import math
from typing import Any

from app.intents.executor_app import ScreenApp
from widgets.core.language import tr

__all__ = ["STEP", "SpeedSteps"]

STEP = 0.2
"""One step changes the greatest speed of the stick by this share of the robot's own."""


class SpeedSteps:
    """On the drive screen's card of the speed."""

    def __init__(self, app: ScreenApp) -> None:
        """`app` is asked for its `shell`."""
        self._app = app

    def _card(self) -> Any:
        return (
            getattr(self._app.shell.screens["drive"], "speed", None) if self._app.shell is not None else None
        )

    def after(self, way: int) -> float:
        """What the greatest speed of the stick would be after a step up (1) or down (-1) [m/s]; NaN where there is none."""
        card = self._card()
        if card is None:
            return math.nan
        fader = card.ids.fader
        return float(min(fader.maximum, max(fader.minimum, card.maximum_speed + way * STEP * fader.maximum)))

    def why_not(self, way: int) -> str:
        """Why there is no step up (1) or down (-1), in one sentence; empty where there is."""
        card = self._card()
        if card is None:
            return tr("This robot has no speed to choose.")
        if abs(self.after(way) - card.maximum_speed) > 1e-6:
            return ""
        return tr("It is as fast as it may be.") if way > 0 else tr("It is as slow as it can be set.")

    def change(self, way: int) -> None:
        """Take a step up (1) or down (-1)."""
        card = self._card()
        card.ids.fader.value = card.maximum_speed = self.after(way)
