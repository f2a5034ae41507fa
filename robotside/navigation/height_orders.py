"""The heights at which a robot goes, and its orders up and down, within what it can and may."""

from __future__ import annotations

import math

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.core.notice import Notice
from robotside.core.refusal import OrderRefused
from robotside.core.robot import Manoeuvrable, Robot
from robotside.navigation.path_controller import PathController

__all__ = ["HeightOrders"]


class HeightOrders:
    """Of one robot; those that stay on the ground have only the one."""

    def __init__(self, robot: Robot, controller: PathController) -> None:
        """`controller` follows the robot's path."""
        self._robot = robot
        self.controller = controller
        """Follows the path."""
        self.heights = (-math.inf, math.inf)
        """The lowest and the highest that it is sent to, above the map's origin [m]."""

    def measured(self, height: float) -> None:
        """The robot is at a `height` above the map's origin [m]."""
        self.controller.measured = height

    def flies(self, phase: str) -> None:
        """Take over the phase of flight of a robot that flies, as in `FlightState`."""
        self.controller.aloft = phase in ("flying", "landing")

    @property
    def height(self) -> float:
        """Of the robot above the map's origin [m]; NaN while not known."""
        return self.controller.measured

    @property
    def kept_height(self) -> float:
        """That it goes at, above the map's origin [m]; NaN for whichever it is at."""
        return self.controller.height

    def keep_height(self, height: float) -> None:
        """Go at a `height` above the map's origin [m] from now on, NaN for the one that it is at; OrderRefused beyond `heights`."""
        self._check_height(height)
        self.controller.height = height

    def take_off(self, height: float) -> None:
        """Rise from the ground to a `height` above the map's origin [m], NaN for the usual one; OrderRefused beyond `heights`."""
        self._check_height(height)
        self.controller.take_off(height)

    def command(self, manoeuvre: Manoeuvre) -> None:
        """The same for what a twist does not say, of a robot that knows manoeuvres; others stay as they are. OrderRefused beyond `heights`."""
        self._check_height(manoeuvre.height)
        if isinstance(self._robot, Manoeuvrable):
            self._robot.manoeuvre(manoeuvre)

    def _check_height(self, height: float) -> None:
        lowest, highest = self.heights
        if height < lowest or height > highest:
            said = f"The height must be from {lowest:g} to {highest:g} m, not {height:g} m; it stays where it is."
            raise OrderRefused(
                Notice(Code.HEIGHT_INVALID, said, height=height, lowest=lowest, highest=highest)
            )
