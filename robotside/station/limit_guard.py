"""The robot's limits at its port: every order is cut to them, and drift beyond them is reported."""

from __future__ import annotations

from collections.abc import Callable

from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.limits.limits import LimitKeeper
from robotside.motion.manoeuvres import VERTICAL_KINDS, Order, paced
from robotside.motion.measured import MeasuredState
from robotside.records.events import Say
from robotside.station.remarks import Remarks

__all__ = ["LimitGuard"]


class LimitGuard:
    """Cuts orders to what may be done just now."""

    def __init__(
        self, keeper: LimitKeeper, measured: Callable[[], MeasuredState], remarks: Remarks, say: Say
    ) -> None:
        self._keeper, self._measured, self._remarks, self._say = keeper, measured, remarks, say
        self._cuts = False
        self.pace = 1.0
        """Share of its speeds that the robot's own loop allows, 0 to 1."""

    def clamp(self, order: Order) -> Order:
        """`order` as far as it may be done; that it is cut is remarked when that begins."""
        done, why = self._keeper.keep(order, self._measured())
        if why and not self._cuts:
            self._remarks.make("limits", why)
        self._cuts = bool(why)
        if self.pace >= 1.0 or (isinstance(done, Manoeuvre) and done.kind in VERTICAL_KINDS):
            return done
        return paced(done, self._keeper.info, self.pace)

    def report_drift(self) -> None:
        """Report that the robot is beyond its limits though it was not driven there; call it with each odometry."""
        said = self._keeper.adrift(self._measured())
        if said:
            self._say("command", said, "warn")
