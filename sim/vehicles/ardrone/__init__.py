"""The ardrone, a quadrotor."""

from sim.vehicles.ardrone.parameters import PARAMETERS, ArdroneParameters
from sim.vehicles.ardrone.vehicle import ARDRONE, Ardrone

__all__ = ["ARDRONE", "PARAMETERS", "Ardrone", "ArdroneParameters"]
