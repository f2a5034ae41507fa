"""The physics engine and what pushes bodies: motors, wind, waves."""
