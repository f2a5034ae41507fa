"""Kinematics: what a manoeuvre commands, where a command leads and how the robot comes to rest."""
