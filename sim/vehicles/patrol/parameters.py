"""The numbers of the patrol robot."""

from __future__ import annotations

from pathlib import Path

from sim.sensors.gps import GpsParameters
from sim.sensors.laser import LaserParameters
from sim.sensors.line import LineParameters
from sim.sensors.ultrasound import UltrasoundParameters
from sim.vehicles.parameters import load
from sim.vehicles.two_wheeled import TwoWheeledParameters

__all__ = ["PARAMETERS", "PatrolParameters"]


class PatrolParameters(TwoWheeledParameters, frozen=True, kw_only=True):
    """The whole file."""

    laser: LaserParameters
    gps: GpsParameters
    line: LineParameters
    ultrasound: UltrasoundParameters


PARAMETERS: PatrolParameters = load(Path(__file__).parent / "patrol.toml", PatrolParameters)
"""The robot's numbers."""
