"""Text fields that take what a keyboard types."""

from __future__ import annotations

from kivy.core.window import Window
from kivy.uix.behaviors import FocusBehavior

__all__ = ["is_typing"]


def is_typing() -> bool:
    """A field in the window has the focus and takes what is typed."""
    everything = (widget for root in Window.children for widget in root.walk())
    return any(isinstance(widget, FocusBehavior) and widget.focus for widget in everything)
