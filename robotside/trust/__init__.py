"""Trust: who may do what with the robot, and how somebody proves who it is."""
