"""Hostile traffic: frames and requests that no robot should have to read, and the processes that send them."""
