"""Surfaces of cards, rows, buttons and bars: a ground within a border, or glass over a picture.

class Tile(Outlined, BoxLayout): ...
<Tile>:
    rim: 'plan' if root.chosen else 'line'
"""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, OptionProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.boxlayout import BoxLayout

from widgets.core.theme import theme

__all__ = ["Edged", "EdgedBox", "Glass", "Outlined", "Pressable", "within_reach"]

Builder.load_string("""
<Outlined>:
    canvas.before:
        Rounded:
            rgba: theme.roles[self.rim] if self.rim else (0, 0, 0, 0)
            pos: self.pos
            size: self.size
            radius: [self.corner]
        Rounded:
            rgba: theme.roles[self.ground] if self.ground else (0, 0, 0, 0)
            pos: self.x + max(self.rim_width, self.bar_width), self.y + self.rim_width
            size: self.width - max(self.rim_width, self.bar_width) - self.rim_width, self.height - 2 * self.rim_width
            radius: [0 if self.bar_width else self.corner - self.rim_width, *[self.corner - self.rim_width] * 2, 0 if self.bar_width else self.corner - self.rim_width]

<Pressable>:
    canvas.before:
        Rounded:
            rgba: theme.roles[self.press_role][:3] + [self.press_share if self.state == 'down' else 0]
            pos: self.pos
            size: self.size
            radius: [self.corner]

<Edged>:
    canvas.before:
        Color:
            rgba: theme.surface
        Rectangle:
            pos: self.pos
            size: self.size
        Color:
            rgba: theme.line
        Rectangle:
            pos: self.right - theme.outline if self.edge == 'right' else self.x, self.top - theme.outline if self.edge == 'top' else self.y
            size: theme.outline if self.edge in ('right', 'left') else self.width, self.height if self.edge in ('right', 'left') else theme.outline

<Glass>:
    canvas.before:
        Rounded:
            rgba: theme.glass if self.card else (0, 0, 0, 0)
            pos: self.pos
            size: self.size
            radius: [self.card_corner]
        Outline:
            rgba: theme.line if self.card else (0, 0, 0, 0)
            rounded_rectangle: self.pos + self.size + [self.card_corner]
            width: theme.outline
""")


class Outlined:
    """Lies on a ground within a border."""

    rim = StringProperty("line")
    """Role of its border; empty for none."""
    ground = StringProperty("raised")
    """Role of what is within the border; empty for nothing."""
    corner = NumericProperty(theme.corner)
    """Radius of its corners [px]."""
    rim_width = NumericProperty(theme.outline)
    """Width of its border [px]."""
    bar_width = NumericProperty(0)
    """Width of its border at the left where that is a bar, which marks what is chosen; 0 where it is none [px]."""


class Pressable(Outlined, ButtonBehavior):
    """A button on such a ground, which changes under a finger."""

    press_role = StringProperty("text")
    """Role of what comes over it while a finger is down."""
    press_share = NumericProperty(0.12)
    """How much of that, 0 to 1."""


def within_reach(widget: Any, x: float, y: float) -> bool:
    """Whether a finger at a point hits a button: its box, or the least target round its centre where no other beside it is hit."""
    across, up = (max(0.0, theme.least - size) / 2 for size in widget.size)
    if not (widget.x - across <= x <= widget.right + across and widget.y - up <= y <= widget.top + up):
        return False
    if _holds(widget, x, y) or widget.parent is None:
        return True
    return not any(
        isinstance(other, ButtonBehavior) and _holds(other, x, y) for other in widget.parent.children
    )


def _holds(widget: Any, x: float, y: float) -> bool:
    return bool(widget.x <= x <= widget.right and widget.y <= y <= widget.top)


class Edged:
    """A bar along an edge of the window, with a line where the screen begins."""

    edge = OptionProperty("bottom", options=["bottom", "right", "left", "top"])
    """Its edge with the line."""


class EdgedBox(Edged, BoxLayout):
    """Such a bar with things side by side."""


class Glass:
    """Lies over a picture, of which it lets a little through."""

    card = BooleanProperty(True)
    """Draw on a card of its own."""
    card_corner = NumericProperty(theme.radius)
    """Radius of the card's corners [px]."""
