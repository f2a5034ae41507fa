"""The screens of the handheld: find a robot, supervise its mission, drive it."""
