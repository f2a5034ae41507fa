"""Signals: controls that send a bool, switched over or held."""
