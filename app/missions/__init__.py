"""Missions and tasks that the operator prepares for a robot, and what its fence would refuse of them."""
