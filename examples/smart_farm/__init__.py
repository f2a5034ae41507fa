"""Oranges: an external program finds them in the camera's pictures, and the arm touches each."""
