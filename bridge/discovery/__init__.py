"""How robots and handhelds find each other on the local network."""
