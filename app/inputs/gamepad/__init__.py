"""Gamepads, their sticks and buttons."""
