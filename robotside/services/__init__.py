"""What clients can ask of a station, by name."""
