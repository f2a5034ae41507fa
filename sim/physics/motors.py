"""Motors that take power and get warm."""

from __future__ import annotations

from collections.abc import Sequence

from bridge.msgs.arrays import Float64Array
from bridge.msgs.pilothouse_msgs import MotorArray
from bridge.msgs.std_msgs import Header, Time
from sim.core.parameters import Part, Positive, Table

__all__ = ["MotorParameters", "Motors"]

AMBIENT_TEMPERATURE = 20.0
"""Temperature of air and water [degC]."""


class MotorParameters(Table, frozen=True, kw_only=True):
    """One of the motors with its gear, all alike."""

    efficiency: Part
    """Of motor and gear, without the losses in the winding."""
    copper: Positive
    """Loss in the winding at 1 N m of output torque, growing with the torque's square [W/(N m)2]."""
    heat_capacity: Positive
    """[J/K]"""
    cooling: Positive
    """To the surroundings [W/K]."""


class Motors:
    """Some motors of the same make; each warms by its own losses and cools towards the surroundings."""

    def __init__(self, parameters: MotorParameters, names: Sequence[str]) -> None:
        """As warm as the surroundings, at rest."""
        self._parameters, self.names = parameters, list(names)
        self.temperatures = [AMBIENT_TEMPERATURE] * len(names)
        """Of each [degC]; may be set."""
        self.speeds = [0.0] * len(names)
        self.torques = [0.0] * len(names)

    def work(self, speeds: Sequence[float], torques: Sequence[float], period: float) -> float:
        """Turn for `period` [s] at `speeds` [rad/s] against `torques` [N m]; gives the electric power taken [W].

        A motor that is driven gives nothing back.
        """
        parameters = self._parameters
        self.speeds, self.torques = list(speeds), list(torques)
        total = 0.0
        for number, (speed, torque) in enumerate(zip(speeds, torques, strict=True)):
            shaft = max(0.0, speed * torque)
            copper = parameters.copper * torque * torque
            lost = copper + shaft * (1 / parameters.efficiency - 1)
            warmer = self.temperatures[number] - AMBIENT_TEMPERATURE
            self.temperatures[number] += (
                (lost - parameters.cooling * warmer) * period / parameters.heat_capacity
            )
            total += shaft + lost
        return total

    def message(self, stamp: float) -> MotorArray:
        """All of them at `stamp` [s]."""
        return MotorArray(
            Header(Time.at(stamp), "base_link"),
            self.names,
            Float64Array(self.speeds),
            Float64Array(self.torques),
            Float64Array(self.temperatures),
        )
