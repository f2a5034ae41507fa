"""Goals and poses: set here, and sent to the robot or its arm."""
