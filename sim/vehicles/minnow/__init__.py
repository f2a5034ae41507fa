"""The minnow, a boat with a propeller and a rudder."""

from sim.vehicles.minnow.parameters import PARAMETERS, MinnowParameters
from sim.vehicles.minnow.vehicle import MINNOW, Minnow

__all__ = ["MINNOW", "PARAMETERS", "Minnow", "MinnowParameters"]
