"""Panels: views of widgets that the operator puts together, live, and the editor of them."""
