"""The ceiling and the floor of the fence as a limit of orders: slower towards them, back from beyond, neither where the height is unknown.

Pure. Limits of height and depth are a ceiling and a floor too; the tightest counts.
"""

from __future__ import annotations

import math

from msgspec.structs import replace

from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist, Vector3
from bridge.msgs.pilothouse_msgs import Manoeuvre, RobotInfo
from robotside.core.config import LimitSettings
from robotside.core.notice import Notice, Problem
from robotside.kinds.registry import described
from robotside.kinds.vehicle_kind import Handling
from robotside.limits.clamped_twist import ClampedTwist
from robotside.limits.fence_guard import MAX_UNCERTAINTY, SIGMAS, uncertainty_margin
from robotside.motion.manoeuvres import levelled
from robotside.motion.measured import MeasuredState
from robotside.motion.stopping_path import REACTION_TIME

__all__ = ["HeightLimit"]

MIN_DIVE_PITCH = 0.1
"""From this pitch on a swimmer goes up and down as it goes ahead, and its fins cannot make up for that [rad]."""
RETURN_GAIN, RETURN_SPEED = 1.5, 0.15
"""Beyond an end what swims or flies goes back by itself [1/s], so fast at most [m/s]: one that is lighter than water drifts on."""
HELD_KINDS = ("course", "hover")
"""Orders that keep a height, the present one where they name none."""


class HeightLimit:
    """Keeps the orders of one robot between a floor and a ceiling."""

    def __init__(self, settings: LimitSettings, info: RobotInfo, handling: Handling) -> None:
        """`handling` is the robot's: how it brakes up and down, and whether it goes where its nose points."""
        self.lowest, self.highest = settings.lowest, settings.highest
        """[m] above the map's origin, negative under water; infinite for none."""
        self._handling = handling
        known = described(info)
        self._sinks_to_land = known.flies and "land" not in info.manoeuvres
        self._returns = known.flies or known.dives

    def __bool__(self) -> bool:
        """There is a floor or a ceiling."""
        return self.lowest > -math.inf or self.highest < math.inf

    def clamp(self, twist: Twist, measured: MeasuredState) -> ClampedTwist:
        """Slower up and down, so that it comes to rest before either; a height that is not known allows neither way."""
        if not self or self._lands(twist):
            return ClampedTwist(twist)
        v, nose = twist.linear, 0.0 if self._handling.sideways else measured.pitch
        rise = v.z * math.cos(nose) - v.x * math.sin(nose)
        down, up = self._rates(measured)
        allowed = max(-down, min(rise, up))
        if abs(nose) < MIN_DIVE_PITCH:
            fitted = Vector3(v.x, v.y, (allowed + v.x * math.sin(nose)) / math.cos(nose))
        else:
            part = allowed / rise if rise else 1.0
            fitted = Vector3(part * v.x, v.y, part * v.z)
        why: Problem = ""
        if abs(allowed) < abs(rise) / 2:
            why = self._no_farther(measured, up=rise > 0)
        return ClampedTwist(Twist(fitted, twist.angular), why)

    def levelled(self, order: Manoeuvre, measured: MeasuredState) -> tuple[Manoeuvre, Problem]:
        """`order` to no height beyond them, and why it is another one; one that keeps its height beyond comes back by itself."""
        low, high = self._bounds(measured)
        asked, here = order.height, measured.height
        done = levelled(order, low, high, here)
        if order.kind in HELD_KINDS and math.isnan(asked) and not (low <= here <= high or math.isnan(here)):
            if not measured.landed and _known(measured):
                done = replace(order, height=max(low, min(here, high)))
            return done, ""
        if math.isnan(asked) or asked == done.height:
            return done, ""
        return done, self._no_farther(measured, up=asked > done.height)

    def _bounds(self, measured: MeasuredState) -> tuple[float, float]:
        """Between which it may be, by as much nearer to each other as its height is uncertain [m]."""
        doubt = uncertainty_margin(measured.height_spread)
        low, high = self.lowest + doubt, self.highest - doubt
        return (low, high) if low <= high else ((low + high) / 2,) * 2

    def _rates(self, measured: MeasuredState) -> tuple[float, float]:
        """How fast it may go down and up [m/s]; infinite where there is no end, negative beyond one, from where it is to come back."""
        if not _known(measured):
            return (
                math.inf if self.lowest == -math.inf else 0.0,
                math.inf if self.highest == math.inf else 0.0,
            )
        low, high = self._bounds(measured)
        down, up = self._speed_within(measured.height - low), self._speed_within(high - measured.height)
        if self._returns and not measured.landed:
            down = down if self._sinks_to_land else down - _back(self.lowest - measured.height)
            up -= _back(measured.height - self.highest)
        return down, up

    def _speed_within(self, room: float) -> float:
        """The speed from which it comes to rest within `room` [m], reaction included [m/s]; 0 beyond it."""
        if room <= 0:
            return 0.0
        braking = self._handling.levelling
        lag = braking * REACTION_TIME
        return math.sqrt(lag * lag + 2 * braking * room) - lag

    def _lands(self, twist: Twist) -> bool:
        """It sinks straight down, which is how one lands that knows no other way: nothing may keep it in the air."""
        v = twist.linear
        return self._sinks_to_land and v.z < 0 and v.x == 0.0 == v.y

    def _no_farther(self, measured: MeasuredState, *, up: bool) -> Notice:
        if not _known(measured):
            said = f"Height unknown: the robot goes no {'higher' if up else 'deeper'} because of its fence."
            return Notice(Code.FENCE_HEIGHT_UNKNOWN, said)
        limit, off = self.highest if up else self.lowest, SIGMAS * measured.height_spread
        known = f": it knows its height to {off:.1f} m only" if uncertainty_margin(off / SIGMAS) else ""
        said = f"The robot goes no {'higher' if up else 'deeper'} than {_level_words(limit)}{known}."
        return Notice(Code.DRIVE_LEVEL, said, height=limit)


def _back(over: float) -> float:
    """The speed back from `over` an end [m]; 0 within it [m/s]."""
    return min(RETURN_GAIN * over, RETURN_SPEED) if over > 0 else 0.0


def _known(measured: MeasuredState) -> bool:
    """Its height is known well enough to keep it between two ends."""
    return not math.isnan(measured.height) and SIGMAS * measured.height_spread <= MAX_UNCERTAINTY


def _level_words(height: float) -> str:
    return f"{height:g} m" if height >= 0 else f"{-height:g} m of depth"
