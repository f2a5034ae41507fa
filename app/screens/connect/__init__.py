"""Finding a robot, and the simulator's choice."""
