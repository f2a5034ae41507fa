"""The heights that an order names, refused where the robot cannot or may not be."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.kinds.registry import described

__all__ = ["MIN_HEIGHT", "OrderHeights", "given_height"]

MIN_HEIGHT = 0.3
"""Least height that a robot in the air is sent to [m]."""


class OrderHeights:
    """Of one robot: between its lowest and its highest."""

    def __init__(self, info: RobotInfo, heights: tuple[float, float]) -> None:
        """`heights` are the lowest and the highest at which it can and may be, above the map's origin [m]."""
        self._info, self._heights = described(info), heights

    @property
    def keeps(self) -> bool:
        """The robot keeps a height: it swims or flies."""
        return self._info.flies or self._info.dives

    def check_point(self, height: float, name: str) -> None:
        """Refuse the `height` of a point [m], NaN and 0 for none; `name` is the point's, as in `Point 3`."""
        if height != 0.0:
            self.check(height, name)

    def check(self, height: float, where: str = "") -> None:
        """Refuse a `height` [m], NaN for none, at which the robot cannot be, or at the point `where`."""
        if math.isnan(height):
            return
        info = self._info
        name, at = info.name, f" at {where[0].lower()}{where[1:]}" if where else ""
        if not self.keeps:
            said = f"{name} keeps no height; leave it out{at}."
            raise Refusal(Notice(Code.HEIGHT_UNUSED, said, robot=name))
        lowest, highest = self._heights
        lowest, highest = (max(MIN_HEIGHT, lowest), highest) if info.flies else (lowest, min(0.0, highest))
        lowest = math.ceil(10 * lowest) / 10 if lowest > -math.inf else lowest
        highest = math.floor(10 * highest) / 10 if highest < math.inf else highest
        if math.isinf(height) or not lowest <= height <= highest:
            allowed = _span_words(lowest, highest, "" if info.flies else ", 0 being the surface")
            world = f" in {info.world}" if info.world else ""
            said = f"The height of {name}{world}{at} must be {allowed}, not {height:g} m."
            raise Refusal(Notice(Code.HEIGHT_INVALID, said, height=height, lowest=lowest, highest=highest))


def given_height(z: float, info: RobotInfo) -> float:
    """The height that a pose from elsewhere asks for by its `z` [m]; NaN for none, as of a robot that keeps none, and of one on a flat map."""
    known = described(info)
    return z if z != 0.0 and math.isfinite(z) and (known.flies or known.dives) else math.nan


def _span_words(lowest: float, highest: float, more: str) -> str:
    """The allowed range, as in `from 0.3 to 30 m`."""
    if math.isinf(highest):
        return f"at least {lowest:g} m{more}"
    if math.isinf(lowest):
        return f"at most {highest:g} m{more}"
    return f"from {lowest:g} to {highest:g} m{more}"
