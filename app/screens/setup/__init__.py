"""The setup screen: a list of the robot's protocols and payloads with switches, and beside it the one that is chosen."""
