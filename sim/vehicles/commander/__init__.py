"""The commander, an Ackermann truck."""

from sim.vehicles.commander.parameters import PARAMETERS, CommanderParameters
from sim.vehicles.commander.vehicle import COMMANDER, Commander

__all__ = ["COMMANDER", "PARAMETERS", "Commander", "CommanderParameters"]
