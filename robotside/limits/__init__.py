"""Limits of the robot's configuration: speeds, depths, heights, the fence and the bumper."""
