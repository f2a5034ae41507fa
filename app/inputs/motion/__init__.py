"""The handheld's motion sensors: shake and tilt."""
