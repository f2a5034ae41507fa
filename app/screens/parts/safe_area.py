"""What of the glass is kept free for the edges of a phone, known to every page: they arrange themselves within."""

from __future__ import annotations

from kivy.event import EventDispatcher
from kivy.properties import ObjectProperty

from app.device.insets import NONE, Insets
from app.layout.rects import Rect

__all__ = ["SafeArea", "safe_area"]


class SafeArea(EventDispatcher):
    """Whoever arranges a whole window binds `insets`."""

    insets: ObjectProperty[Insets] = ObjectProperty(NONE)
    """From each edge inward [px]."""

    def within(self, width: float, height: float) -> Rect:
        """What is left of a window of that size [px]."""
        left, top, right, bottom = self.insets
        return Rect(left, bottom, max(width - left - right, 1.0), max(height - top - bottom, 1.0))


safe_area = SafeArea()
"""The one of this process."""
