"""The replay screen: recordings, and what was seen, where the robot was and what it said at any moment of one."""
