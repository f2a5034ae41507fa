"""The one card that may lie over the map, and how much of the map is left free beside it."""

from __future__ import annotations

from typing import Any

from kivy.uix.widget import Widget

from app.core.hand import hand
from app.layout.arrange import Rect
from app.layout.rects import all_mirrored, mirrored
from app.screens.parts.placing import put

__all__ = ["MapCard", "map_insets"]

WIDTH = 400.0
"""Of the card where there is room for it [dp]."""
MIN_MAP_WIDTH = 130.0
"""So much of the map beside it is left to be seen and tapped [dp]."""
MIN_MAP_HEIGHT = 126.0
"""The same above it, on an upright phone [dp]."""


class MapCard:
    """Lies at the side of the map that STOP is not at; on an upright phone above STOP, with a strip of the map over it."""

    def __init__(self, screen: Widget) -> None:
        """`screen` holds the card, above all that floats on its map."""
        self._screen = screen
        self.shown: Any = None
        """The card; None while there is none."""
        self.place: Rect | None = None
        """Where it is [px]; None while there is none."""

    @property
    def open(self) -> bool:
        """There is a card."""
        return self.shown is not None

    def show(self, card: Any) -> None:
        """Have this card and no other."""
        if self.shown is not None:
            self._screen.remove_widget(self.shown)
        self.shown, self.place = card, None
        if card is not None:
            self._screen.add_widget(card)

    def leave(self) -> bool:
        """Have the card ask no more; False where there is none."""
        if self.shown is None:
            return False
        self.shown.leave()
        return True

    def arrange(self, places: dict[str, Rect], body: Rect, form: str, dp: float) -> None:
        """Put it over the map of `arrange.mission` in a window of that `form`; `dp` is one dp [px]."""
        if self.shown is None:
            self.place = None
            return
        area, gap = places["map"], 12 * dp
        if hand.left:
            places = all_mirrored(places, area)
        if form == "tall":
            low, top = places["panel"].y, area.top - MIN_MAP_HEIGHT * dp
            self.place = Rect(body.x + gap, low, body.width - 2 * gap, top - low)
        else:
            right = places["tools"].x - gap
            width = min(WIDTH * dp, right - MIN_MAP_WIDTH * dp - area.x - gap)
            low, top = area.y + gap, area.top - gap
            if form == "wide":  # the camera stays in sight
                low, top = places["video"].top + gap, places["modes"].y - gap
            self.place = Rect(area.x + gap, low, width, top - low)
        if hand.left:
            self.place = mirrored(self.place, area)
        put(self.shown, self.place)


def map_insets(places: dict[str, Rect], form: str, card: Rect | None) -> list[float]:
    """How much of the map of `arrange.mission` is covered by what lies over it [px]: left, bottom, right, top."""
    if hand.left:
        room = places["map"]
        there = None if card is None else mirrored(card, room)
        right, low, left, top = _insets(all_mirrored(places, room), form, there)
        return [left, low, right, top]
    return _insets(places, form, card)


def _insets(places: dict[str, Rect], form: str, card: Rect | None) -> list[float]:
    """The same for a right hand."""
    area, video, bar = places["map"], places["video"], places["selection"]
    top = area.top - places["modes"].y if form != "tall" else 0.0
    low = places["modes"].top - area.y if form == "tall" else 0.0
    left, right = 0.0, area.right - places["tools"].x
    if "compass" in places:
        low = max(places["compass"].top, video.top) - area.y
    elif form == "short":
        beside = bar.x > video.right
        left = bar.x - area.x if beside else 0.0
        low = (bar if beside else video).top - area.y
    if card is None:
        return [left, low, right, top]
    if form == "tall":
        return [video.right - area.x, card.top - area.y, right, 0.0]
    return [card.right - area.x, 0.0 if form == "short" else low, right, top]
