"""Pairing with a robot, and the people whom it knows."""
