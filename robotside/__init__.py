"""The robot's computer: serves the bridge, decides who steers, runs tasks, keeps missions."""

import os

# before numpy is loaded: nothing here is large enough to be shared among threads, each of which takes memory
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
