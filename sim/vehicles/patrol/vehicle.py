"""The patrol robot: two wheels, a laser, a camera, a satellite receiver, a line sensor, ultrasounds."""

from __future__ import annotations

from collections.abc import Iterator

from sim.physics.backend_bullet import State
from sim.sensors.gps import Gps
from sim.sensors.laser import Laser
from sim.sensors.line import LineCells
from sim.sensors.suite import AFTER_GROUND, AFTER_LASER, AFTER_WHEELS, Measurement
from sim.sensors.ultrasound import Ultrasounds
from sim.vehicles.model import Model
from sim.vehicles.patrol.looks import looks
from sim.vehicles.patrol.parameters import PARAMETERS, PatrolParameters
from sim.vehicles.two_wheeled import TwoWheeled
from sim.world.paint import Paint

__all__ = ["PATROL", "Patrol"]


class Patrol(TwoWheeled[PatrolParameters]):
    """The robot in a world that already has its ground and its things."""

    def add_own(self) -> None:
        """Laser, satellite receiver, line sensor and ultrasounds."""
        own, scene, suite = self.parameters, self.scene, self.suite
        laser = Laser(own.laser, scene.backend, self.body, scene.generator("laser"))
        gps = Gps(own.gps, scene.world.datum, scene.generator("gps"))
        line = LineCells(own.line, Paint(scene.world), scene.generator("line"))
        self._ultrasounds = Ultrasounds(
            own.ultrasound, scene.backend, self.body, scene.generator("ultrasound")
        )
        suite.add("laser", own.laser.rate, lambda _, at: [("/scan", laser.measure(at))], after=AFTER_WHEELS)
        suite.add(
            "gps", own.gps.rate, lambda state, at: [("/fix", gps.measure(state, at))], after=AFTER_GROUND
        )
        suite.add(
            "line_sensor",
            own.line.rate,
            lambda state, at: [("/line_sensor", line.measure(state, at))],
            after=AFTER_LASER,
        )
        suite.add("ultrasound", own.ultrasound.rate, self._measure_echoes, after=AFTER_GROUND)

    def _measure_echoes(self, _: State, stamp: float) -> Iterator[Measurement]:
        for side, echo in self._ultrasounds.measure(stamp):
            yield f"/range/{side}", echo


PATROL = Model(Patrol, PARAMETERS, looks, "land")
"""All that is needed to make one."""
