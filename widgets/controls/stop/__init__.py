"""STOP, STOP ALL and the list of what they stopped."""
