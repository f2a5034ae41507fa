"""Sensors of the simulated robots; one file a sensor, with its parameters and its noise."""
