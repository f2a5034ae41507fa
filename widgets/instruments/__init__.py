"""Instruments: motion, attitude and condition of a robot."""
