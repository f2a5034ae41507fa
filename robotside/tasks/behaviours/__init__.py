"""Behaviours of the tasks, as trees: each leaf does one thing, each ending leaves the robot at rest."""
