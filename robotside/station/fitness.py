"""Fitness of the robot to move by itself: map, sensors, position, limits and charge."""

from __future__ import annotations

from collections.abc import Callable

from bridge.core.codes import Code
from robotside.autonomy.autonomy import Autonomy
from robotside.control.command_gate import CommandGate
from robotside.core.notice import Notice, Problem
from robotside.limits.limits import LimitKeeper

__all__ = ["NO_MAP", "Fitness"]

NO_MAP = Notice(Code.MAP_MISSING, "There is no map: the robot can be driven by hand only.")


class Fitness:
    """Each property says why not, as one sentence; empty when nothing is in the way."""

    def __init__(
        self,
        autonomy: Autonomy,
        controls: CommandGate,
        keeper: LimitKeeper,
        trouble: Callable[[], Problem],
        now: Callable[[], float],
    ) -> None:
        """`trouble` is why the robot cannot be reached, empty when it can; `now` is the robot's clock [s]."""
        self._autonomy, self._controls, self._keeper = autonomy, controls, keeper
        self._trouble, self._now = trouble, now

    @property
    def mapless(self) -> Problem:
        """Why the robot cannot be placed on a map."""
        return self._trouble() or ("" if self._autonomy.has_map else NO_MAP)

    @property
    def unfit(self) -> Problem:
        """Why the robot can do nothing by itself, for any task."""
        silence = self._autonomy.silence(self._now())
        if self.mapless or not silence:
            return self.mapless
        return Notice(Code.SENSORS_SILENT, f"It can be driven by hand only: {silence}.")

    @property
    def lost(self) -> Problem:
        """Why the robot cannot set out from where it is."""
        pose = self._autonomy.pose_estimator.pose
        if pose is None:
            said = "The robot's position is unknown; place the robot on the map."
            return Notice(Code.POSITION_UNKNOWN, said)
        return self._keeper.outside(pose)

    def barred(self, drains: bool) -> str:
        """Why no task may start by itself just now, one that needs charge or not."""
        if self._controls.stopped:
            return "STOP is pressed"
        if self._controls.driving:
            return "the robot is driven by hand"
        if drains and self._autonomy.low:
            return f"the battery is at {self._autonomy.battery:.0%}"
        return self.unfit or self.lost
