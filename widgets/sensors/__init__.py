"""Sensor views: what a robot sees, hears and touches around it."""
