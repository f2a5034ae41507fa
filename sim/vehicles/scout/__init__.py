"""The scout, a drum on two driven wheels with a ring of sonars."""

from sim.vehicles.scout.parameters import PARAMETERS, ScoutParameters
from sim.vehicles.scout.vehicle import SCOUT, Scout

__all__ = ["PARAMETERS", "SCOUT", "Scout", "ScoutParameters"]
