"""The words all other rooms share: the robot's port, the bus, poses, the configuration, the clock."""
