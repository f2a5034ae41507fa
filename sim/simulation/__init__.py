"""A world and its robots, stepped together."""
