"""Profiles of the operator's own: kept beside the built-in layouts, edited step by step, and shared."""
