"""Measurements of Pilothouse: every figure with its target and the program that it is compared with."""

import os

# before numpy is loaded: the robot side counts with one thread, and so it is measured
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
