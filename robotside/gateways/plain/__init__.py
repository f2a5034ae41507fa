"""Plain JSON messages and their clients, for protocols that have no form of their own for a robot's messages."""
