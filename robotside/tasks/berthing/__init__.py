"""Berths of robots that float and fly: each brings the robot to a charger of its kind, or leaves it at rest and says what was seen."""
