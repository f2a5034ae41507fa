"""Measurements of Pilothouse: every figure with its target and the program that it is compared with."""
