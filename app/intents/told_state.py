"""Answers to questions about the robot: its battery and its task, as it tells them."""

from __future__ import annotations

import math

from app.intents.robot_access import RobotAccess
from widgets.core.language import tr
from widgets.core.task_words import STATES, TASKS

__all__ = ["ToldState"]


class ToldState(RobotAccess):
    """Needs no control of the robot. The reasons are one sentence; empty where there is an answer."""

    def why_not_battery(self) -> str:
        """Why the charge cannot be told."""
        if not self._session.connected:
            return tr("There is no link to the robot.")
        return "" if math.isfinite(self._charge()) else tr("This robot does not tell its charge.")

    def battery(self) -> str:
        """The charge, as in `Battery: 82 %`; without a figure where it is not known."""
        charge = self._charge()
        return f"{tr('Battery')}: {charge * 100:.0f} %" if math.isfinite(charge) else tr("Battery")

    def why_not_task(self) -> str:
        """Why it cannot be told what the robot does."""
        if not self._session.connected:
            return tr("There is no link to the robot.")
        return "" if self.state() in STATES else tr("This robot does not tell its task.")

    def task(self) -> str:
        """Its task and how that stands, as in `Patrol: paused`."""
        if self.status is None or self.status.state not in STATES:
            return tr("Task")
        state = tr(STATES[self.status.state][2])
        named = TASKS.get(self.status.task)
        return f"{named.name if named is not None else tr('Task')}: {state}"

    def _charge(self) -> float:
        """0 to 1, NaN unknown."""
        told = self._session.feeds.latest("/battery_state")
        return float(told.percentage) if told is not None else math.nan
