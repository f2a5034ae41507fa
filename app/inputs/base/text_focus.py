"""Text fields that take what a keyboard types."""

from __future__ import annotations

from kivy.core.window import Window
from kivy.uix.behaviors import FocusBehavior

__all__ = ["is_typing", "typed_in"]


def typed_in() -> FocusBehavior | None:
    """The field in the window that has the focus and takes what is typed; None without one."""
    everything = (widget for root in Window.children for widget in root.walk())
    return next((widget for widget in everything if isinstance(widget, FocusBehavior) and widget.focus), None)


def is_typing() -> bool:
    """A field in the window takes what is typed."""
    return typed_in() is not None
