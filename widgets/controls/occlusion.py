"""Occlusion of controls: one with something over it, or scrolled out of sight, can no longer be meant by a hand."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.gridlayout import GridLayout
from kivy.uix.modalview import ModalView
from kivy.uix.stencilview import StencilView
from kivy.uix.widget import Widget

__all__ = ["covered", "covering", "cut_off"]

ROUND = 0.96
"""Of a stick's width and height is its round, less an edge that a neighbour may touch."""
BARE = (FloatLayout, BoxLayout, AnchorLayout, GridLayout, Widget)
"""Classes that show nothing themselves: they cover what their children cover."""


def covered(widget: Widget) -> bool:
    """Something is drawn over the round in the widget's middle, or that is scrolled out of sight, or it is not on the glass."""
    top: Any = next(reversed([*_holders(widget)]), widget)
    return top.parent is not top or cut_off(widget) or any(True for _ in covering(widget))


def covering(widget: Widget) -> Iterator[Widget]:
    """Everything that is drawn over the round in the widget's middle, be it seen through or not: also what is in what lies over it."""
    round_ = (*widget.to_window(*widget.center), min(widget.size) * ROUND / 2)
    child: Any = widget
    for holder in _holders(widget):
        siblings = holder.children
        for other in siblings[: siblings.index(child)] if child in siblings else ():
            yield from _over(other, round_)
        child = holder


def cut_off(widget: Widget) -> bool:
    """The widget's middle is outside of what shows only a part of what it holds, as a list that scrolls does."""
    x, y = widget.to_window(*widget.center)
    for holder in _holders(widget):
        if isinstance(holder, StencilView):
            left, low = holder.to_window(*holder.pos)
            if not (left <= x <= left + holder.width and low <= y <= low + holder.height):
                return True
    return False


def _holders(widget: Widget) -> Iterator[Any]:
    """What holds it, from within; the last is the window where it is on the glass."""
    child: Any = widget
    while child.parent is not None and child.parent is not child:
        child = child.parent
        yield child


def _over(widget: Widget, round_: tuple[float, float, float]) -> Iterator[Widget]:
    if not widget.opacity or not all(widget.size):
        return
    if isinstance(widget, ModalView):  # it takes every finger, however small it is
        yield widget
    x, y, radius = round_
    left, low = widget.to_window(*widget.pos)
    nearest = min(max(x, left), left + widget.width), min(max(y, low), low + widget.height)
    if math.dist(nearest, (x, y)) >= radius:
        return
    if type(widget) not in BARE:
        yield widget
    for child in widget.children:
        yield from _over(child, round_)
