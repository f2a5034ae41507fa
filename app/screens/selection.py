"""The bar over the map that says what is selected, and holds what can be done with it."""

from __future__ import annotations

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.kit  # noqa: F401 - its rules draw what is used here

__all__ = ["SelectionBar"]

Builder.load_string("""
<SelectionBar>:
    size_hint: None, None
    padding: dp(12), dp(6), dp(6), dp(6)
    spacing: dp(6)
    canvas.before:
        Color:
            rgba: theme.line
        SmoothRoundedRectangle:
            pos: self.pos
            size: self.size
            radius: [theme.corner]
        Color:
            rgba: theme.surface
        SmoothRoundedRectangle:
            pos: self.x + theme.outline, self.y + theme.outline
            size: self.width - 2 * theme.outline, self.height - 2 * theme.outline
            radius: [theme.corner - theme.outline]
    Text:
        text: root.text
        font_size: sp(15)
        shorten: True
        shorten_from: 'right'
        max_lines: 1
        pos_hint: {'center_y': .5}
""")


class SelectionBar(BoxLayout):
    """What is selected on the map, and what can be done with it."""

    text = StringProperty("")
