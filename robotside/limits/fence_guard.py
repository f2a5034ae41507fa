"""The fence guard: it slows a command until its stopping path stays inside the fence."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from robotside.core.pose2 import Points, Pose2
from robotside.kinds.vehicle_kind import Handling
from robotside.limits.fence import Fence
from robotside.motion.stopping_path import REST, PlanarVelocity, reach, track

__all__ = [
    "GAP",
    "LEVEL_DISTANCE",
    "MAX_UNCERTAINTY",
    "TRACK_GAP",
    "SIGMAS",
    "FenceGuard",
    "uncertainty_margin",
]

GAP = 0.10
"""Kept between the body and the fence on the way of a command that is obeyed at once [m]."""
TRACK_GAP = 0.02
"""Kept on the way that the robot takes from how it moves now [m]: it lags behind its last command."""
RETURN_GAIN = 1.0
"""Gain by which a robot that slides along nearer than GAP moves inward [1/s]: otherwise it would drift out."""
SIGMAS, MAX_UNCERTAINTY = 2.0, 2.0
"""A place counts as off by so many standard deviations, and by no more than so much [m]: beyond that the fence is not promised."""
LEVEL_DISTANCE = 1.5
"""Nearer than this to the fence one that glides aside is made to roll less, and not at all where it begins [m]."""
_MIN_SPEED = 0.05
"""The speed to which what glides aside slows down within its room [m/s]."""
_HALVINGS = 6


def uncertainty_margin(spread: float) -> float:
    """Farther than GAP from the fence [m], for a place that is off by `spread` [m], one standard deviation; 0 for NaN."""
    return max(0.0, min(SIGMAS * spread, MAX_UNCERTAINTY) - GAP) if spread > 0 else 0.0


class FenceGuard:
    """Keeps one robot, a disc of `radius` [m], within `fence`."""

    def __init__(self, fence: Fence, radius: float, handling: Handling) -> None:
        self._fence, self._radius, self._handling = fence, radius, handling

    def room(self, pose: Pose2) -> float:
        """From the body to the fence [m]; negative when a part of it is outside."""
        return float(self._fence.clearance(np.array([[pose.x, pose.y]]))[0]) - self._radius

    def inward(self, pose: Pose2) -> tuple[float, float]:
        """The direction away from the nearest fence, of length 1 in `base_link`; (0, 0) on it and without one."""
        x, y = self._fence.inward(pose.x, pose.y)
        c, s = math.cos(pose.yaw), math.sin(pose.yaw)
        return c * x + s * y, c * y - s * x

    def slowed(
        self, pose: Pose2, moving: PlanarVelocity, wanted: PlanarVelocity, doubt: float = 0.0
    ) -> PlanarVelocity:
        """`wanted` as it may be obeyed at `pose`, give or take `doubt` [m], by a robot that is `moving`.

        Where a part of the body is outside already, every way that leads no farther out is allowed.
        """
        room = self.room(pose) - doubt
        wanted = self._unhurried(pose, wanted, room)
        if room > reach(moving, wanted, self._handling) + GAP:
            return wanted
        test = self._test(pose, moving, wanted, room, self._radius + doubt)
        if test(wanted):
            return wanted
        steers = self._handling.steers
        if self._handling.sideways and (slid := self._slid(pose, wanted, room, test)) is not None:
            return slid
        if not test(wanted.scaled(0.0, 0.0 if steers else 1.0)):
            return REST
        return _greatest(lambda part: wanted.scaled(part, part if steers else 1.0), test)

    def outward(self, pose: Pose2, moving: PlanarVelocity) -> float:
        """The speed towards the nearest fence [m/s]; negative when away from it."""
        x, y = self.inward(pose)
        return -(moving.x * x + moving.y * y)

    def unhurried(self, room: float) -> float:
        """The fastest towards the fence that has `room` [m] for one that glides [m/s]; infinite for others."""
        glide = self._handling.glide
        return _MIN_SPEED * math.expm1(min(max(room - GAP, 0.0) / glide, 50.0)) if glide else math.inf

    def _unhurried(self, pose: Pose2, wanted: PlanarVelocity, room: float) -> PlanarVelocity:
        """Slower towards the fence, since a turn leaves the way that it has; the turn is left as it is."""
        out, most = self.outward(pose, wanted), self.unhurried(room)
        return wanted if out <= most else wanted.scaled(most / out)

    def _test(
        self, pose: Pose2, moving: PlanarVelocity, wanted: PlanarVelocity, room: float, radius: float
    ) -> Callable[[PlanarVelocity], bool]:
        """Whether a command keeps to the fence, which has `room` beside a disc of `radius` [m]."""
        far = reach(moving, wanted, self._handling) + radius + GAP
        near = self._fence.around(pose.x, pose.y, far)
        # from inside, nothing gets to the other side of the border without coming near to it
        distance: Callable[[Points], Points] = near.distance if room > TRACK_GAP else self._fence.clearance

        def kept(start: PlanarVelocity, command: PlanarVelocity, gap: float, *, swings: bool = False) -> bool:
            way = track(pose, start, command, self._handling, swings=swings)
            return bool(distance(way).min() - radius >= min(gap, room) - 1e-6)

        return lambda command: (
            kept(command, command, GAP)
            and kept(moving, command, TRACK_GAP)
            and kept(moving, command, TRACK_GAP, swings=True)
        )

    def _slid(
        self, pose: Pose2, wanted: PlanarVelocity, room: float, test: Callable[[PlanarVelocity], bool]
    ) -> PlanarVelocity | None:
        """As much of the part towards the fence as can be, and all of the part along it; None when that is too much."""
        in_x, in_y = self.inward(pose)
        out = min(0.0, wanted.x * in_x + wanted.y * in_y)
        back = RETURN_GAIN * max(0.0, GAP - room)

        def less(part: float) -> PlanarVelocity:
            spare = (1.0 - part) * out - back
            return PlanarVelocity(wanted.x - spare * in_x, wanted.y - spare * in_y, wanted.turn)

        if not test(less(0.0)):
            return None
        return less(0.0) if back else _greatest(less, test)


def _greatest(
    command: Callable[[float], PlanarVelocity], test: Callable[[PlanarVelocity], bool]
) -> PlanarVelocity:
    """The command of the greatest part, 0 to 1, that passes; that of 0 is known to."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if test(command(middle)) else (low, middle)
    return command(low)
