"""The scout: a SuperScout with sixteen sonars, a bumper ring and odometry."""

from __future__ import annotations

from sim.sensors.sonar import Sonar
from sim.vehicles.model import Model
from sim.vehicles.scout.looks import looks
from sim.vehicles.scout.parameters import PARAMETERS, ScoutParameters
from sim.vehicles.two_wheeled import TwoWheeled

__all__ = ["SCOUT", "Scout"]


class Scout(TwoWheeled[ScoutParameters]):
    """The robot in a world that already has its ground and its things."""

    def add_own(self) -> None:
        """The ring of sonars."""
        own = self.parameters.sonar
        sonar = Sonar(own, self.scene.backend, self.body, self.scene.generator("sonar"))
        self.suite.add("sonar", own.rate, lambda _, at: [("/sonar", sonar.measure(at))])


SCOUT = Model(Scout, PARAMETERS, looks, "land", home="office")
"""All that is needed to make one."""
