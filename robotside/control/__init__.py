"""Whether a command may move the robot: authority, expiry, speed cap, STOP and safe states."""
