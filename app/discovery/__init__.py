"""Robots that can be connected to: on the network, entered by hand, or simulated."""
