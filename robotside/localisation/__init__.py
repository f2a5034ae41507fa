"""Where the robot believes it is, and how sure it is of that."""
