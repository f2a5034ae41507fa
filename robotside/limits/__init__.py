"""What the robot's configuration allows: speeds, depths, heights, the fence and the bumper."""
