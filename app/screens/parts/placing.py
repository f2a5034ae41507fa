"""Putting a widget where `app.layout.arrange` says, and the areas that are put there whole."""

from __future__ import annotations

from kivy.lang import Builder
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.layout.arrange import Rect

__all__ = ["AWAY_X", "MIN_READABLE_HEIGHT", "Area", "above", "put"]

AWAY_X = -1e4
"""x of what is off the glass [px]."""
MIN_READABLE_HEIGHT = 120.0
"""Lower ones show nothing that can be read [dp]."""

Builder.load_string("""
<Area>:
    orientation: 'vertical'
    size_hint: None, None
    spacing: dp(8)
""")


class Area(BoxLayout):
    """Part of a screen: what is in it lies one below the other."""


def put(widget: Widget, rect: Rect) -> None:
    """Give a widget this place on the glass, whatever its parent would like."""
    widget.size_hint = (None, None)
    widget.pos, widget.size = (rect.x, rect.y), (rect.width, rect.height)


def off(place: Rect) -> Rect:
    """As large, off the glass."""
    return Rect(AWAY_X, place.y, place.width, place.height)


def above(place: Rect, cover: Rect | None, dp: float, least: float = MIN_READABLE_HEIGHT) -> Rect:
    """What is left of a place above what covers its lower part; all of it where nothing does.

    Where less than `least` [dp] would be left it is off the glass: what can be read only in part is better not seen.
    """
    if cover is None or not place.overlaps(cover):
        return place
    low = cover.top + 8 * dp
    if place.top - low < least * dp:
        return Rect(AWAY_X, place.y, place.width, place.height)
    return Rect(place.x, low, place.width, place.top - low)
