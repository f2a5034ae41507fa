"""Berths: each brings a robot to the charger of its kind, on the ground or out of the air, or leaves it at rest and says what was seen."""
