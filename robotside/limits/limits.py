"""Limits of the robot's configuration: drive commands are clamped to them, goals outside are refused.

Pure: what the robot measures is passed in. Speeds are limited to what it may; `robotside.limits.fence_limit` keeps it within the areas of
its fence, and `robotside.limits.height_limit` between floor and ceiling.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import msgspec
import numpy as np

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Point32, Polygon, Twist
from bridge.msgs.pilothouse_msgs import Limits, RobotInfo
from robotside.core.config import LimitSettings, Ring
from robotside.core.notice import Notice, Problem
from robotside.core.pose2 import Pose2
from robotside.core.text import place_sentence
from robotside.kinds.registry import kind_of
from robotside.kinds.vehicle_kind import Handling
from robotside.limits.clamped_twist import ClampedTwist, scaled
from robotside.limits.fence import Fence
from robotside.limits.fence_limit import NOT_PLACED, FenceLimit
from robotside.limits.grip_limit import braked_by, held_in_bend
from robotside.limits.height_limit import HeightLimit
from robotside.mapping.occupancy_grid import Grid
from robotside.motion.manoeuvres import VERTICAL_KINDS, Order, kept, leads_to
from robotside.motion.measured import MeasuredState
from robotside.motion.speed_limit import slower

__all__ = ["GOAL_ROOM", "NOT_PLACED", "PATH_ROOM", "ClampedTwist", "KeptOrder", "LimitKeeper", "turned_over"]

GOAL_ROOM = 0.4
"""Kept between the body and the fence at a goal [m]: following a path is not exact."""
PATH_ROOM = 0.15
"""Of the map, what is nearer than this to the fence is no place to plan through [m]."""
STEEP_SLOPE_SHARE, STEEP_SPEED_SHARE = 0.8, 0.3
"""From this part of the greatest slope on it goes slower, down to this part of the speed."""
OVERTURNED_COSINE = 0.2
"""Cosine of the tilt from which on a robot has turned over."""


class KeptOrder(NamedTuple):
    """An order of any kind as it may be done."""

    order: Order
    why: Problem = ""
    """As that of `ClampedTwist`."""


def turned_over(measured: MeasuredState, kind: str) -> bool:
    """A robot of this `kind` lies on its side or its back, as only a swimmer may."""
    over = math.cos(measured.roll) * math.cos(measured.pitch) < OVERTURNED_COSINE
    return not kind_of(kind).dives and (over or measured.overturned)


class LimitKeeper:
    """Keeps one robot to its limits."""

    def __init__(self, settings: LimitSettings, info: RobotInfo) -> None:
        """`settings` are the configuration's, `info` what the robot says of itself."""
        self._settings = settings
        self._own, self._radius = info, info.radius
        known = kind_of(info.kind).handling
        self._grip = settings.grip if kind_of(info.kind).on_the_ground else None
        self._handling: Handling = braked_by(
            replace(known, braking=settings.braking or known.braking), self._grip
        )
        self._heights = HeightLimit(settings, info, self._handling)
        self._slope = math.radians(settings.max_slope_degrees or 0.0) or math.inf
        self._came: tuple[float, float] | None = None
        self._fence = Fence(settings.keep_in, settings.keep_out)
        self.info: RobotInfo = msgspec.structs.replace(
            info,
            max_speed=min(info.max_speed, settings.max_speed or math.inf),
            max_yaw_rate=min(info.max_yaw_rate, settings.max_yaw_rate or math.inf),
        )
        """The robot's information, with the speeds that it is allowed."""
        self._fence_limit = FenceLimit(self._fence, info, self._handling, self.info.max_speed)
        self._last: tuple[Twist, MeasuredState, ClampedTwist] = (
            Twist(),
            MeasuredState(),
            ClampedTwist(Twist()),
        )
        """The last request and its result."""

    @property
    def message(self) -> Limits:
        """For `/limits`."""
        told = self._settings
        return Limits(
            max_speed=_or_nan(told.max_speed),
            max_yaw_rate=_or_nan(told.max_yaw_rate),
            min_depth=_or_nan(told.min_depth),
            max_depth=_or_nan(told.max_depth),
            max_height=_or_nan(told.max_height),
            max_slope=math.radians(_or_nan(told.max_slope_degrees)),
            floor=_or_nan(told.floor),
            ceiling=_or_nan(told.ceiling),
            clearance=_or_nan(told.clearance),
            keep_in=[_polygon(ring) for ring in told.keep_in],
            keep_out=[_polygon(ring) for ring in told.keep_out],
        )

    def heights(self, own: tuple[float, float]) -> tuple[float, float]:
        """The lowest and the highest [m] at which it may be that can go from one to the other of its `own`."""
        return max(own[0], self._heights.lowest), min(own[1], self._heights.highest)

    def fault(self, name: str, x: float, y: float) -> Problem:
        """Why the robot may not be sent to a place [m, in `map`], as one sentence that calls it `name`; empty when it may."""
        if not self._fence:
            return ""
        where = place_sentence(name, x, y)
        room = self.room(x, y)
        if not room > 0:
            return Notice(
                Code.PLACE_OUTSIDE_FENCE, f"{where} is outside the robot's fence.", place=name, x=x, y=y
            )
        need = self._radius + max(GOAL_ROOM, self._fence_limit.uncertainty + 2 * PATH_ROOM)
        if room < need:
            said = f"{where} is {room:.2f} m from the robot's fence; the robot needs {need:.2f} m."
            return Notice(Code.PLACE_NEAR_FENCE, said, place=name, x=x, y=y)
        return ""

    def room(self, x: float, y: float) -> float:
        """From a place [m, in `map`] to the fence [m]; negative outside, infinite without one."""
        return float(self._fence.clearance(np.array([[x, y]]))[0])

    def outside(self, pose: Pose2 | None) -> Problem:
        """Why the robot cannot start by itself from where it is, as one sentence; empty when it can."""
        if pose is None or not self._fence or self._fence.allows(np.array([pose[:2]]))[0]:
            return ""
        said = f"{place_sentence('The robot', pose.x, pose.y)} is outside its fence; drive it back by hand first."
        return Notice(Code.FENCE_LEFT, said, x=pose.x, y=pose.y)

    def marked(self, grid: Grid) -> Grid:
        """The map to plan on: where one may not be counts as occupied."""
        return self._fence.marked(grid, PATH_ROOM)

    def clamp(self, twist: Twist, measured: MeasuredState) -> ClampedTwist:
        """`twist` as it may be done now; call it again whenever something new is measured."""
        if self._last[:2] != (twist, measured):
            self._last = twist, measured, self._clamped(twist, measured)
        return self._last[2]

    def keep(self, order: Order, measured: MeasuredState) -> KeptOrder:
        """`order` as it may be done now, of any kind; as a twist where the robot does not know the kind."""
        if isinstance(order, Twist):
            return KeptOrder(*self.clamp(order, measured))
        own = self._own
        order, cut = self._heights.levelled(order, measured)
        if order.kind == "tilt" and (roll := self._fence_limit.rolled(order.roll, measured)) != order.roll:
            order = msgspec.structs.replace(order, roll=roll)
        leads = leads_to(order, own, measured)
        may, why = self.clamp(leads, measured)
        why = why or cut
        if self._fence_limit.returning and order.kind not in VERTICAL_KINDS:
            return KeptOrder(may, why)
        if order.kind not in own.manoeuvres or turned_over(measured, own.kind):
            return KeptOrder(may, why)
        return KeptOrder(kept(order, leads, may, own), why)

    def adrift(self, measured: MeasuredState) -> Problem:
        """The sentence about a robot that is carried over its fence; empty for none.

        Call it whenever something new is measured.
        """
        return self._fence_limit.adrift(measured, judged=self._last[1] == measured)

    def _clamped(self, twist: Twist, measured: MeasuredState) -> ClampedTwist:
        self._fence_limit.returning = False
        if turned_over(measured, self.info.kind):
            name = self.info.name or "The robot"
            said = f"{name} has turned over; put it upright first."
            return ClampedTwist(Twist(), Notice(Code.ROBOT_OVERTURNED, said, robot=name))
        slowed = slower(twist, self.info.max_speed, self.info.max_yaw_rate)
        slowed = held_in_bend(slowed, self._handling, self._grip)
        fitted = self._heights.clamp(slowed, measured)
        level = self._level(fitted.twist, measured)
        fenced = self._fence_limit.clamp(level.twist, measured)
        return ClampedTwist(fenced.twist, fitted.why or level.why or fenced.why)

    def _level(self, twist: Twist, measured: MeasuredState) -> ClampedTwist:
        """Slower where it is steep; too steep, only back to where it came from."""
        tilt = math.acos(max(-1.0, min(1.0, math.cos(measured.roll) * math.cos(measured.pitch))))
        if tilt < STEEP_SLOPE_SHARE * self._slope:
            self._came = None
            return ClampedTwist(twist)
        v = twist.linear
        if tilt < self._slope:
            part = (self._slope - tilt) / (self._slope * (1 - STEEP_SLOPE_SHARE))
            return ClampedTwist(scaled(twist, max(STEEP_SPEED_SHARE, part), self._handling))
        if self._came is None:
            self._came = _direction(measured)
        if v.x * self._came[0] + v.y * self._came[1] <= 0:
            return ClampedTwist(scaled(twist, STEEP_SPEED_SHARE, self._handling))
        said = f"It is steeper here, {math.degrees(tilt):.0f} degrees, than the {math.degrees(self._slope):.0f} allowed"
        return ClampedTwist(
            scaled(twist, 0.0, self._handling), Notice(Code.DRIVE_STEEP, f"{said}; drive back.")
        )


def _direction(measured: MeasuredState) -> tuple[float, float]:
    """Where it was going, of length 1 in `base_link`; uphill when it stands."""
    x, y = measured.moving.x, measured.moving.y
    if math.hypot(x, y) < 0.02:
        x, y = -math.sin(measured.pitch), math.sin(measured.roll)
    far = max(math.hypot(x, y), 1e-9)
    return x / far, y / far


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def _polygon(ring: Ring) -> Polygon:
    return Polygon([Point32(x, y) for x, y in ring])
