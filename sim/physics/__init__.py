"""The physics engine, the rigid bodies in it, and motors."""
