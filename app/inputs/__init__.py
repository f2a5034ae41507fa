"""The ways to give commands, switched on and off together."""
