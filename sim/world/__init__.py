"""Worlds from their files: shapes, props, paint, the robot's own map."""
