"""Putting a widget where `app.arrange` says."""

from __future__ import annotations

from kivy.uix.widget import Widget

from app.arrange import Rect

__all__ = ["put"]


def put(widget: Widget, rect: Rect) -> None:
    """Give a widget this place on the glass, whatever its parent would like."""
    widget.size_hint = (None, None)
    widget.pos, widget.size = (rect.x, rect.y), (rect.width, rect.height)
