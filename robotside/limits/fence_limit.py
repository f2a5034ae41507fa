"""The fence as a limit of drive commands: slower towards it, back from outside of it, careful where the place is unsure."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.kinds.registry import kind_of
from robotside.kinds.vehicle_kind import Handling
from robotside.limits.clamped_twist import ClampedTwist, scaled
from robotside.limits.fence import Fence
from robotside.limits.fence_guard import (
    LEVEL_DISTANCE,
    MAX_UNCERTAINTY,
    SIGMAS,
    FenceGuard,
    uncertainty_margin,
)
from robotside.motion.measured import MeasuredState
from robotside.motion.speed_limit import within
from robotside.motion.station_keeping import (
    CREEP_SPEED,
    MIN_DRIFT,
    RETURN_BELOW,
    RETURN_UNTIL,
    DriftMonitor,
    back,
    way_back,
)
from robotside.motion.stopping_path import PlanarVelocity

__all__ = ["NOT_PLACED", "FenceLimit"]

UNSURE_SHARE = 0.25
"""A robot that is not sure of its place goes at this part of its speed while it has a fence."""
NOT_PLACED = Notice(
    Code.FENCE_UNPLACED,
    "Position unknown: the robot cannot keep to its fence. Place it on the map.",
)


class FenceLimit:
    """Keeps the drive commands of one robot to its fence."""

    def __init__(self, fence: Fence, info: RobotInfo, handling: Handling, max_speed: float) -> None:
        """`handling` is the robot's, with the configured braking; `max_speed` is the one that it is allowed [m/s]."""
        self._fence, self._handling, self._max_speed = fence, handling, max_speed
        self._name, self._comes_about = info.name, kind_of(info.kind).comes_about
        self._guard = FenceGuard(fence, info.radius, handling)
        self._drift = DriftMonitor()
        self._returns, self._way = False, 0.0
        self.uncertainty = 0.0
        """Added to the distance that is kept from the fence, since the place is uncertain [m]."""
        self.returning = False
        """The last clamped twist brings the robot back by itself."""

    def clamp(self, twist: Twist, measured: MeasuredState) -> ClampedTwist:
        """Slower towards the fence, and slowly all ways where the place is not sure."""
        self.returning = False
        v, pose = twist.linear, measured.pose
        if not self._fence:
            return ClampedTwist(twist)
        if pose is None:
            return (
                ClampedTwist(scaled(twist, 0.0, self._handling), NOT_PLACED)
                if v.x or v.y
                else ClampedTwist(twist)
            )
        doubt, unsure = uncertainty_margin(measured.spread), _unsure(measured)
        if unsure:
            most = UNSURE_SHARE * self._max_speed
            far = math.hypot(v.x, v.y)
            twist = scaled(twist, most / far, self._handling) if far > most else twist
        clamped = self._within(twist, measured, pose, doubt)
        if self._drifts_out(measured.moving, pose, doubt, clamped.twist):
            inward = self._guard.inward(pose)
            self._way = 0.0 if self._handling.glide else way_back(inward, self._way)
            home = back(inward, self._way)
            rolls, levels = self._roll_rate(0.0, measured), -within(measured.pitch, 0.5)
            kept = Twist(Vector3(home.linear.x, 0.0, twist.linear.z), Vector3(rolls, levels, home.angular.z))
            self.returning = True
            return ClampedTwist(kept, clamped.why)
        return ClampedTwist(clamped.twist, clamped.why or (unsure if v.x or v.y else ""))

    def rolled(self, roll: float, measured: MeasuredState) -> float:
        """As much of a `roll` [rad] as one that glides may have here: rolled, its fins push it aside."""
        if not (self._handling.glide and self._fence and measured.pose):
            return roll
        room = self._guard.room(measured.pose) - uncertainty_margin(measured.spread)
        return roll * max(0.0, min(1.0, room / LEVEL_DISTANCE))

    def adrift(self, measured: MeasuredState, *, judged: bool) -> Problem:
        """The sentence about a robot that is carried over its fence, whether it may go back or STOP is pressed; empty for none.

        `judged` when `clamp` was called with the same measurements. Call it whenever something new is measured.
        """
        self.uncertainty = uncertainty_margin(measured.spread) if self._fence else 0.0
        pose = measured.pose
        if not self._fence or pose is None:
            return ""
        room, outward = self._guard.room(pose), self._guard.outward(pose, measured.moving)
        returns = self.returning and judged
        if returns:
            room, outward = min(room - self.uncertainty, RETURN_BELOW), max(outward, MIN_DRIFT)
        return self._drift.check(self._name, room, outward, returns=returns)

    def _within(self, twist: Twist, measured: MeasuredState, pose: Pose2, doubt: float) -> ClampedTwist:
        v, w = twist.linear, twist.angular
        creeps = self._comes_about and w.z != 0.0 and abs(v.x) < CREEP_SPEED
        wanted = PlanarVelocity(math.copysign(CREEP_SPEED, v.x) if creeps else v.x, v.y, w.z)
        if not wanted.speed:
            return ClampedTwist(twist)
        done = self._guard.slowed(pose, measured.moving, wanted, doubt)
        w = Vector3(self._roll_rate(w.x, measured), w.y, w.z)
        if done is wanted:
            return ClampedTwist(Twist(v, w))
        kept = Twist(Vector3(done.x, done.y, v.z), Vector3(w.x, w.y, done.turn))
        if creeps:
            kept = Twist(Vector3(0.0, 0.0, v.z), Vector3(w.x, w.y, 0.0))
        elif done.speed > wanted.speed / 2:
            return ClampedTwist(kept)
        room = self._guard.room(pose)
        where = f"is {room:.1f} m away" if room > 0.05 else "is here"
        known = f" and it knows its place to {SIGMAS * measured.spread:.1f} m only" if doubt else ""
        said = f"The robot's fence {where}{known}: it goes no nearer."
        return ClampedTwist(kept, Notice(Code.FENCE_NEAR, said, room=room))

    def _drifts_out(self, moving: PlanarVelocity, pose: Pose2, doubt: float, kept: Twist) -> bool:
        """It is carried over the fence, or will be, and what is left of its order does not bring it back."""
        if not self._handling.drifts:
            return False
        room, out = self._guard.room(pose) - doubt, self._guard.outward(pose, moving)
        most = self._guard.unhurried(room)
        if self._returns:
            self._returns = room < RETURN_UNTIL or out > most
        else:
            self._returns = (room < RETURN_BELOW and out > MIN_DRIFT) or out > most + 2 * MIN_DRIFT
        inward = -self._guard.outward(pose, PlanarVelocity(kept.linear.x, kept.linear.y, 0.0))
        if not self._returns:
            self._way = 0.0
        return self._returns and inward < CREEP_SPEED / 2

    def _roll_rate(self, rate: float, measured: MeasuredState) -> float:
        """One that is rolled farther than it may rolls back [rad/s]."""
        over = measured.roll - self.rolled(measured.roll, measured)
        return -within(over, 0.5) if abs(over) > 0.05 else rate


def _unsure(measured: MeasuredState) -> Problem:
    """Why its place is not sure enough to promise a fence, as one sentence; empty when it is."""
    off = SIGMAS * measured.spread
    if measured.sure and not off > MAX_UNCERTAINTY:
        return ""
    how = f" to {off:.1f} m" if off > MAX_UNCERTAINTY else ""
    said = f"Position unsure{how}: the robot goes slowly because of its fence. Place it on the map."
    return Notice(Code.FENCE_UNSURE, said)
