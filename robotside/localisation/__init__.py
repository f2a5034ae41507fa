"""Localisation: the pose in the map, and its uncertainty."""
