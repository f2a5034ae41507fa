"""Driving: sticks, instruments, camera."""
