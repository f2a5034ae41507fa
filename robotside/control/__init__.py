"""Judgement of commands before they move the robot: authority, expiry, speed cap, STOP and safe states."""
