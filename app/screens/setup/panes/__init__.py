"""Panes of the setup screen, one module each: what an operator chooses for this handheld."""
