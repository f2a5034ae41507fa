"""The process that listens, and its line to the app."""
