"""Where real fingers find something to press: probed without pressing it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from kivy.core.window import Window
from kivy.input.motionevent import MotionEvent
from kivy.uix.label import Label
from kivy.uix.scrollview import ScrollView
from kivy.uix.textinput import TextInput
from kivy.uix.widget import Widget

__all__ = ["Taken", "bound", "taken"]

SHARES = ((0.5, 0.5), (0.15, 0.5), (0.85, 0.5), (0.5, 0.12), (0.5, 0.88))
"""Of width and height of what may be pressed, where it is probed."""


class Taken(Exception):
    """A widget was about to take the finger."""

    def __init__(self, widget: Any) -> None:
        super().__init__(widget)
        self.widget = widget


class Probe(MotionEvent):
    """A finger that withdraws as soon as something takes hold of it."""

    def __init__(self, x: float, y: float) -> None:
        super().__init__("probe", 1, (x, y), is_touch=True, type_id="touch")
        self.pos = self.x, self.y = x, y
        self.ox, self.oy = self.px, self.py = x, y
        self.z = self.oz = self.pz = self.dz = 0.0
        self.dx = self.dy = 0.0

    def depack(self, args: tuple[float, float]) -> None:
        self.profile = ["pos"]
        self.sx, self.sy = args[0] / Window.width, args[1] / Window.height
        super().depack(args)

    def grab(self, class_instance: Any, exclusive: bool = False) -> None:
        raise Taken(class_instance)


def taken(skip: list[Any], room: Any = None) -> dict[int, Any]:
    """Every widget that takes a finger somewhere in the window, or in `room`; `skip` are those that act at once."""
    found: dict[tuple[int, int], list[Any]] = {}
    left, low, right, top = (0, 0, Window.width, Window.height) if room is None else box(room)
    boxes = [box(one) for one in skip]
    with lying_still():
        for one in _listening():
            for x, y in _spots(one):
                on_glass = left <= x < right and low <= y < top
                if (x, y) not in found:
                    free = on_glass and not any(b[0] <= x <= b[2] and b[1] <= y <= b[3] for b in boxes)
                    found[x, y] = list(probe(x, y)) if free else []
                if any(widget is one for widget in found[x, y]):
                    break  # what lies over the rest of it listens too, and has spots of its own
    return {id(widget): widget for widgets in found.values() for widget in widgets}


def _listening() -> list[Any]:
    """All that is seen and does not leave fingers to what is in it."""
    every = [one for root in Window.children for one in root.walk(restrict=True)]
    return [one for one in every if one.opacity and _listens(one)]


def _spots(one: Any) -> list[tuple[int, int]]:
    """Where a finger may find it."""
    left, low, right, top = box(one)
    return [(round(left + across * (right - left)), round(low + up * (top - low))) for across, up in SHARES]


def _listens(widget: Any) -> bool:
    """It has a way of its own with fingers; a text has one for links, of which there are none."""
    kind = type(widget)
    ways = ("on_touch_down", "on_touch_up")
    own = any(getattr(kind, way) not in (getattr(Widget, way), getattr(Label, way)) for way in ways)
    return own or bool(widget.get_property_observers("on_touch_down"))


def probe(x: float, y: float) -> Iterator[Any]:
    for child in Window.children[:]:
        try:
            child.dispatch("on_touch_down", Probe(x, y))
        except Taken as end:
            if isinstance(end.widget, TextInput):
                end.widget.focus = False
            if not isinstance(end.widget, ScrollView):
                yield end.widget
            return


@contextmanager
def lying_still() -> Iterator[list[Any]]:
    """What scrolls hands each finger on to what is in it, as it does with a second one."""
    views = [
        one for root in Window.children for one in root.walk(restrict=True) if isinstance(one, ScrollView)
    ]
    for view in views:
        view._touch = view._touch or view
    yield views
    for view in views:
        view._touch = None


def bound(root: Any) -> list[Any]:
    """What does something at a touch that somebody bound to it."""
    return [
        one
        for one in root.walk(restrict=True)
        if one.opacity
        and not one.disabled
        and min(one.size) > 1
        and not isinstance(one, ScrollView)
        and one.get_property_observers("on_touch_down")
    ]


def box(widget: Any) -> tuple[float, float, float, float]:
    return *widget.to_window(*widget.pos), *widget.to_window(widget.right, widget.top)
