"""A robot's motion, attitude and condition."""
