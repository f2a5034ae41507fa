"""Reception of connections: who gets a place on a listening socket, and whether it speaks TLS."""
