"""Kivy's own widgets."""
