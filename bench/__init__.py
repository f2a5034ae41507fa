"""Measurements of Pilothouse: every figure with its target and with what it was measured against."""
