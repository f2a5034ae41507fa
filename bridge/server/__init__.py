"""The robot's end of the socket: the rosbridge server and its camera sockets."""
