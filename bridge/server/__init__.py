"""The robot's end of the socket."""
