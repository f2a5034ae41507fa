"""Bringing the robot to a place: planning, path following and avoidance."""
