"""Payloads: what a robot carries and does, as one table that all gateways and their guides go by."""
