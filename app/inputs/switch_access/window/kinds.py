"""Kinds of widgets by what a finger can do to them: press once, or something that opens a pad of steps."""

from __future__ import annotations

from typing import Any

from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.recycleview import RecycleView
from kivy.uix.scrollview import ScrollView
from kivy.uix.textinput import TextInput
from kivy.uix.widget import Widget

from widgets import HeadingDial, StopAll, StopButton
from widgets.controls.finger_grip import Grip
from widgets.controls.hold_progress import Hold
from widgets.controls.slide_confirm import SlideToConfirm
from widgets.controls.sticks.stick import Stick
from widgets.map.map_gestures import MapGestures
from widgets.parts.cards import Banner, Sheet, SheetGrip
from widgets.parts.choices import Toggle
from widgets.parts.rows import DragHandle
from widgets.parts.sliders import Fader
from widgets.parts.stepper import StepperEnd

__all__ = ["kind_of"]


def kind_of(widget: Widget) -> str:
    """How it is used, as in `Openings`; `press` for what one tap does, empty for what takes no finger."""
    for kinds, how in _TABLE:
        if isinstance(widget, kinds):
            return str(how(widget) if callable(how) else how)
    return "press" if _taps_in_other_ways(widget) else ""


def _button(widget: Any) -> str:
    """Some buttons are at times only there to be read."""
    idle = getattr(widget, "pressable", True) is False or getattr(widget, "foldable", True) is False
    return "" if idle else "press"


def _stop(widget: Any) -> str:
    """STOP itself is pressed by both switches together; what is latched is let go by holding it."""
    held = widget.phase == "stopped" or (widget.local and widget.phase in ("no_answer", "moves"))
    return "hold" if held else ""


def _scrolls(widget: Any) -> str:
    high = max((child.height for child in widget.children), default=0)
    wide = max((child.width for child in widget.children), default=0)
    over = (widget.do_scroll_y and high > widget.height + 1) or (
        widget.do_scroll_x and wide > widget.width + 1
    )
    return "scroll" if over else ""


def _taps_in_other_ways(widget: Any) -> bool:
    """It takes a finger in a way of its own, as a card that unfolds."""
    return bool(getattr(widget, "shown", None)) and bool(getattr(widget, "foldable", False))


def _banner(widget: Any) -> str:
    return "press" if widget.closable else ""


_TABLE: tuple[tuple[Any, Any], ...] = (
    (StopButton, _stop),
    (StopAll, "press"),
    (TextInput, "field"),
    (MapGestures, "map"),
    (SlideToConfirm, "slide"),
    (Stick, "stick"),
    (Grip, "area"),
    (HeadingDial, "area"),
    (Fader, "fader"),
    (DragHandle, "handle"),
    (StepperEnd, "step"),
    (Toggle, "press"),
    (Hold, "hold"),
    (ButtonBehavior, _button),
    (SheetGrip, "press"),
    (Sheet, ""),
    (Banner, _banner),
    (RecycleView, _scrolls),
    (ScrollView, _scrolls),
)
"""Classes to how they are used, the special ones first."""
