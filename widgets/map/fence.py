"""Fence that a robot reports: its lines on a map, and the places that the robot would refuse. No Kivy in here.

The robot judges by itself (`/limits`, docs/bridge.md); this says beforehand, in its words, what it is going to say.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from bridge.core.fence import Border, FenceGeometry
from bridge.msgs.pilothouse_msgs import Limits
from widgets.core.geometry import Points
from widgets.core.language import figure, tr
from widgets.core.quantities import said

__all__ = ["GOAL_ROOM", "MAX_CORNERS", "Border", "Fence"]

GOAL_ROOM = 0.4
"""Distance that a robot needs between its body and the fence at a place that it is sent to [m]."""
MAX_CORNERS = 2000
"""Of a fence that is drawn: one with more would take longer than a finger waits."""
MAX_JUDGED = 1000
"""Places whose judgement is kept: a map asks for all of its marks each time it is drawn."""


class Fence(FenceGeometry):
    """The areas of one robot in `map` [m]; areas of one kind that touch are one."""

    def __init__(
        self,
        keep_in: Sequence[Points] = (),
        keep_out: Sequence[Points] = (),
        floor: float = -math.inf,
        ceiling: float = math.inf,
    ) -> None:
        """Corners of each area, shape (n, 2) [m]; a ring that is no area, or not finite, is left out.

        `floor` and `ceiling` are above the map's origin [m], infinite for none.
        """
        self.floor, self.ceiling = floor, ceiling
        areas = _areas(keep_in), _areas(keep_out)
        self.too_large = sum(map(len, (*areas[0], *areas[1]))) > MAX_CORNERS
        """It has so many corners that nothing of it is drawn or looked at."""
        super().__init__(*(() if self.too_large else areas))
        self._judged: dict[tuple[float, float, float], bool] = {}

    @classmethod
    def of(cls, limits: Limits) -> Fence:
        """The fence that a robot reports."""
        keep_in, keep_out = (
            [np.array([[corner.x, corner.y] for corner in area.points], dtype=np.float64) for area in areas]
            for areas in (limits.keep_in, limits.keep_out)
        )
        low = [value for value in (limits.floor, -limits.max_depth) if math.isfinite(value)]
        tops = (limits.ceiling, limits.max_height, -limits.min_depth)
        high = [value for value in tops if math.isfinite(value)]
        return cls(keep_in, keep_out, max(low, default=-math.inf), min(high, default=math.inf))

    def forbids(self, x: float, y: float, radius: float) -> bool:
        """Whether a robot of `radius` [m] would not go to (x, y) [m]; asked again of the same place it costs nothing."""
        key = (x, y, radius)
        if key not in self._judged:
            if len(self._judged) >= MAX_JUDGED:
                self._judged.clear()
            self._judged[key] = bool(self.fault(tr("It"), x, y, radius))
        return self._judged[key]

    def fault(self, name: str, x: float, y: float, radius: float) -> str:
        """Why a robot of `radius` [m] would not go to a place that is called `name`, as one sentence; empty when it would."""
        if not self or not (math.isfinite(x) and math.isfinite(y)):
            return ""
        where, need, here = (
            tr("{name} at ({x}, {y})").format(name=name, x=figure(x, 1), y=figure(y, 1)),
            radius + GOAL_ROOM,
            np.array([[x, y]]),
        )
        if not self.allows(here)[0]:
            return tr("{where} is outside the robot's fence.").format(where=where)
        room = float(self.border.distance(here)[0])
        if room < need:
            words = tr("{where} is {room} from the robot's fence; the robot needs {need}.")
            free, wanted = said(room, "height", 2).words, said(need, "height", 2).words
            return words.format(where=where, room=free, need=wanted)
        return ""

    def height_fault(self, name: str, height: float) -> str:
        """Why the robot would not go to a `height` [m] at a place that is called `name`, as one sentence; empty for none, and where it would."""
        if not math.isfinite(height) or self.floor <= height <= self.ceiling:
            return ""
        return tr("{name} is not between floor and ceiling of the robot's fence.").format(name=name)


def _areas(rings: Sequence[Points]) -> list[Points]:
    return [ring for ring in rings if ring.ndim == 2 and len(ring) >= 3 and np.isfinite(ring).all()]
