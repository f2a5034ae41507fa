"""What the simulated robots measure with; one file a sensor, its parameters and its noise beside it."""
