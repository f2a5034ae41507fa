"""Simulated robots and the worlds they drive in, behind the same port as a real robot."""
