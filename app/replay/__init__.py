"""Recordings of the past: read piece by piece, indexed, and played."""
