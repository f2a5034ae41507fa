"""Row of a tree of fields, and the room that its texts take."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from kivy.core.text import Label as CoreLabel
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw the icon
from widgets.core.base import text_texture
from widgets.core.theme import theme
from widgets.fields.message_fields import ARRAY, LEAF, Path

__all__ = ["FieldRow", "line_width", "text_width", "whole_height"]

Builder.load_string("""
<FieldRow>:
    size_hint: None, None
    canvas.before:
        Rounded:
            rgba: theme.raised if root.foldable else (0, 0, 0, 0)
            pos: self.x + root.indent - dp(8), self.y + dp(2)
            size: self.width - root.indent + dp(8), self.height - dp(4)
            radius: [theme.corner * .7]
        Rounded:
            rgba: theme.text[:3] + [.14 if root.state == 'down' else 0]
            pos: self.x + root.indent - dp(8), self.y + dp(2)
            size: self.width - root.indent + dp(8), self.height - dp(4)
            radius: [theme.corner * .7]
        Color:
            rgba: theme.line if not root.foldable else (0, 0, 0, 0)
        Rectangle:
            pos: self.x + root.indent, round(self.y)
            size: self.width - root.indent - dp(12), max(1, round(theme.outline))  # less than a pixel comes and goes
    Icon:
        name: 'expand_less' if root.open else 'expand_more'
        role: 'muted'
        font_size: sp(20)
        opacity: 1 if root.foldable else 0
        center_y: root.top - root.lead - root.line / 2
        x: root.x + root.indent - dp(2)
    Label:
        text: root.name
        font_name: theme.font
        font_size: sp(15)
        bold: root.foldable
        color: theme.text if root.foldable else theme.muted
        disabled_color: self.color
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'left'
        valign: 'middle'
        size_hint: None, None
        size: root.name_width, root.line
        x: root.name_x
        top: root.top - root.lead
    Label:
        text: root.type
        font_name: theme.font
        font_size: sp(12.5)
        color: theme.muted
        disabled_color: self.color
        opacity: 1 if root.type_width else 0
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'left'
        valign: 'middle'
        size_hint: None, None
        size: root.type_width, root.line
        x: root.name_x + root.name_width + dp(9)
        top: root.top - root.lead - dp(1)
    Label:
        text: root.value
        underline: root.picked
        font_name: theme.font
        font_size: sp(15)
        bold: True
        color: theme.accent if root.picked else theme.text if root.kind != 'branch' else theme.muted
        disabled_color: self.color
        shorten: True
        shorten_from: 'right'
        text_size: self.size
        halign: 'right'
        valign: 'middle'
        size_hint: None, None
        size: root.value_width, root.line
        x: root.right - dp(12) - root.unit_width - root.value_width
        top: root.top - root.lead
    Label:
        text: root.unit
        font_name: theme.font
        font_size: sp(13)
        color: theme.muted
        disabled_color: self.color
        text_size: self.size
        halign: 'right'
        valign: 'middle'
        size_hint: None, None
        size: root.unit_width, root.line
        x: root.right - dp(12) - root.unit_width
        top: root.top - root.lead - dp(.5)
    Label:
        text: root.second
        font_name: theme.font
        font_size: sp(14)
        color: theme.text
        disabled_color: self.color
        shorten: not root.open
        shorten_from: 'right'
        text_size: self.width, None if root.open else self.height
        halign: 'left'
        valign: 'middle'
        size_hint: None, None
        size: max(0, root.right - dp(12) - root.name_x), self.texture_size[1] if root.open else dp(24)
        opacity: 1 if root.second else 0
        x: root.name_x
        y: root.top - root.lead - root.line + dp(1) - self.height
""")


def text_width(text: str, size: float, *, bold: bool = False) -> float:
    """Of a text [px], with the little that Kivy wants before it shortens none of it; 0 for none."""
    return text_texture(text, size, theme.font, bold=bold).width + dp(1) + 3.0 if text else 0.0


@lru_cache(maxsize=64)
def line_width(text: str, size: float, font: str) -> float:
    """Of a text on one line [px]; unlike `text_width` it keeps no picture of what may be long."""
    return float(CoreLabel(font_size=size, font_name=font).get_extents(text)[0]) + 1.0


@lru_cache(maxsize=64)
def whole_height(text: str, size: float, font: str, width: float) -> float:
    """Of a text on as many lines as it takes [px]."""
    label = CoreLabel(text=text, font_size=size, font_name=font, text_size=(width, None))
    return float(label.render()[1])


class FieldRow(ButtonBehavior, Widget):
    """One line of the tree. A finger presses it where there is something to fold."""

    kind = StringProperty(LEAF)
    name = StringProperty("")
    type = StringProperty("")
    """ROS type."""
    value = StringProperty("")
    second = StringProperty("")
    """What stands on a line of its own."""
    unit = StringProperty("")
    """Behind the value."""
    open = BooleanProperty(False)
    foldable = BooleanProperty(False)
    picks = BooleanProperty(False)
    """A finger can choose it: it is a number, and somebody wants to know."""
    picked = BooleanProperty(False)
    """It has been chosen."""
    depth = NumericProperty(0)
    step = NumericProperty("16dp")
    """Farther in for each level [px]."""

    path: Path = ()
    widest = NumericProperty(0.0)
    """Of the values that this field has had [px]: the type does not come and go with the length of a figure."""

    def _indent(self) -> float:
        return dp(10) + self.depth * self.step

    indent = AliasProperty(_indent, bind=["depth", "step"], cache=True)
    """From the left edge to the line's beginning [px]."""

    def _name_x(self) -> float:
        return float(self.x + self.indent + (dp(22) if self.foldable else 0))

    name_x = AliasProperty(_name_x, bind=["x", "indent", "foldable"], cache=True)

    def _line(self) -> float:
        return float(dp(26) if self.kind == ARRAY else self.height)

    line = AliasProperty(_line, bind=["kind", "height"], cache=True)
    """Height of the first line [px]."""

    def _lead(self) -> float:
        if self.kind != ARRAY:
            return 0.0
        return float(dp(5)) if self.open else float(self.height - dp(50)) / 2

    lead = AliasProperty(_lead, bind=["kind", "height", "open"], cache=True)
    """Above the first line [px]."""

    def _widths(self) -> tuple[float, float, float]:
        """Of name, type and value [px]: the value first, then the name; the type where there is room for all of it."""
        room = self.x + self.width - dp(12) - self.name_x - self.unit_width
        value = min(text_width(self.value, sp(15), bold=True), room * 0.7)
        name = text_width(self.name, sp(15), bold=self.foldable)
        name = max(0.0, min(name, room - value - (dp(10) if value else 0)))
        spare = room - max(value, min(self.widest, room * 0.7)) - name - dp(19)
        kind = text_width(self.type, sp(12.5))
        return name, kind if kind <= spare else 0.0, value

    widths = AliasProperty(
        _widths,
        bind=["width", "name_x", "value", "name", "type", "foldable", "widest", "unit_width"],
        cache=True,
    )

    def _unit_width(self) -> float:
        return text_width(self.unit, sp(13)) + dp(2) if self.unit else 0.0

    unit_width = AliasProperty(_unit_width, bind=["unit"], cache=True)
    """With the room before it [px]."""

    def _name_width(self) -> float:
        return float(self.widths[0])

    def _type_width(self) -> float:
        return float(self.widths[1])

    def _value_width(self) -> float:
        return float(self.widths[2])

    name_width = AliasProperty(_name_width, bind=["widths"], cache=True)
    type_width = AliasProperty(_type_width, bind=["widths"], cache=True)
    value_width = AliasProperty(_value_width, bind=["widths"], cache=True)

    def on_touch_down(self, touch: Any) -> bool:
        """Leave the finger to the list where nothing can be folded or chosen."""
        return bool((self.foldable or self.picks) and super().on_touch_down(touch))
