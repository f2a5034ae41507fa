"""A mark for widgets that keep fingers and switches from everything below them."""

from __future__ import annotations

__all__ = ["Modal"]


class Modal:
    """Mixin of a widget that covers the whole window until it is answered or closed."""
