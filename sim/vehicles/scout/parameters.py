"""The numbers of the scout."""

from __future__ import annotations

from pathlib import Path

from sim.sensors.sonar import SonarParameters
from sim.vehicles.parameters import load
from sim.vehicles.two_wheeled import TwoWheeledParameters

__all__ = ["PARAMETERS", "ScoutParameters"]


class ScoutParameters(TwoWheeledParameters, frozen=True, kw_only=True):
    """The whole file."""

    sonar: SonarParameters


PARAMETERS: ScoutParameters = load(Path(__file__).parent / "scout.toml", ScoutParameters)
"""The robot's numbers."""
