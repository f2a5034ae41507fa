"""The protocols by which clients reach a station."""
