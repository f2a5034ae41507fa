"""Occlusion of controls: one with something over it can no longer be meant by a hand."""

from __future__ import annotations

import math

from kivy.core.window import Window
from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

__all__ = ["covered"]

ROUND = 0.96
"""Of a stick's width and height is its round, less an edge that a neighbour may touch."""
BARE = (FloatLayout, BoxLayout, AnchorLayout, GridLayout, Widget)
"""Classes that show nothing themselves: they cover what their children cover."""


def covered(widget: Widget) -> bool:
    """Something is drawn over the round in the widget's middle, or it is not on the glass."""
    child, middle = widget, widget.to_window(*widget.center)
    round_ = (*middle, min(widget.size) * ROUND / 2)
    while child.parent is not None and child.parent is not child:
        siblings = child.parent.children
        if any(_over(other, round_) for other in siblings[: siblings.index(child)]):
            return True
        if child.parent is Window:
            return False
        child = child.parent
    return True


def _over(widget: Widget, round_: tuple[float, float, float]) -> bool:
    if not widget.opacity or not all(widget.size):
        return False
    x, y, radius = round_
    left, low = widget.to_window(*widget.pos)
    nearest = min(max(x, left), left + widget.width), min(max(y, low), low + widget.height)
    apart = math.dist(nearest, (x, y)) >= radius
    if apart or type(widget) not in BARE:
        return not apart
    return any(_over(child, round_) for child in widget.children)
