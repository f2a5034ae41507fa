"""Perception of intruders, in the camera picture and on the map."""
