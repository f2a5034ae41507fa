"""STOP and STOP ALL, from the press to what the robot confirmed."""
