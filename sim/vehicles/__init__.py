"""The simulated robots, one folder each: its numbers in a TOML file, its parts put together in Python."""
