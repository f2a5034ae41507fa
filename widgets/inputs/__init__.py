"""Input methods as pictures, help, tests and lessons: keys, pads, switches, shakes, voices."""
