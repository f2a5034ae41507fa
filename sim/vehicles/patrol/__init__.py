"""The patrol robot, on two driven wheels."""

from sim.vehicles.patrol.parameters import PARAMETERS, PatrolParameters
from sim.vehicles.patrol.vehicle import PATROL, Patrol

__all__ = ["PARAMETERS", "PATROL", "Patrol", "PatrolParameters"]
