"""The web site of a robot: STOP, health and camera pictures for browsers and scripts."""
