"""One service call by each protocol that a robot speaks."""
