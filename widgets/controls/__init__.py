"""Controls: what a finger drives, commands and stops with."""
