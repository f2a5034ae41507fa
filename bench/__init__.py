"""Measurements of what the user feels and what the machine pays: `python -m bench`."""
