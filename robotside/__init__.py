"""The robot's computer: serves the bridge, decides who steers, runs tasks, keeps missions."""
