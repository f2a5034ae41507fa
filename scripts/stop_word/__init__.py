"""Training of the network that hears the word STOP in running sound."""
