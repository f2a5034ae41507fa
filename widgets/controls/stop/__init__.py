"""STOP, STOP ALL and the list of their outcome."""
