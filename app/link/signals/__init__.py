"""Signals: what controls of a view tell topics of the robot's own, beside everything that drives it."""
