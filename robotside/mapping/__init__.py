"""Maps and sensor sweeps as arrays and points."""
