"""The aqua, a swimmer with six fins."""

from sim.vehicles.aqua.parameters import PARAMETERS, AquaParameters
from sim.vehicles.aqua.vehicle import AQUA, Aqua

__all__ = ["AQUA", "PARAMETERS", "Aqua", "AquaParameters"]
