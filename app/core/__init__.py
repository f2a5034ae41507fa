"""Foundations of every room: settings, a worker thread, the origin of a command."""
