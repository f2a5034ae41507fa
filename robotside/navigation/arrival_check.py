"""The check at the goal: the robot is there once it is sure of its place; until then it stands and looks."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from robotside.core.notice import Notice

__all__ = ["SURE_TIMEOUT", "UNSURE_THERE", "ArrivalCheck"]

SURE_TIMEOUT = 5.0
"""So long it stands at the goal and waits to be sure of its place [s]."""

UNSURE_THERE = "There, unsure of its place. Place the robot on the map, then start again."
"""What an operator reads at the end of a task that is not done for that."""


class ArrivalCheck:
    """Times are of the robot's clock [s]."""

    def __init__(self) -> None:
        self._since = math.inf

    @property
    def waits(self) -> bool:
        """It stands where the goal should be, and is not sure of that."""
        return self._since < math.inf

    def forget(self) -> None:
        """It is on its way, or was moved."""
        self._since = math.inf

    def skip(self, seconds: float) -> None:
        """The clock jumped by `seconds` [s], in which nothing happened."""
        self._since += seconds

    def refusal(self, name: str, now: float) -> Notice | None:
        """It came to where the goal `name` should be and is not sure at `now`: None while that may change, else why it is not there."""
        self._since = min(self._since, now)
        if now - self._since < SURE_TIMEOUT:
            return None
        return Notice(Code.TASK_PLACE_UNSURE, UNSURE_THERE, place=name)
