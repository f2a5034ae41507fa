"""What an agent that learns to drive is given: places to start from and to go to, and measurements as arrays."""
