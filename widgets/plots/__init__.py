"""Numbers over time: several traces in one plot, with pause, zoom and a cursor."""
