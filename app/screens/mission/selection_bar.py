"""The bar over the map that says what is selected, holds what can be done with it, and what is wrong with it."""

from __future__ import annotations

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from widgets.core.surfaces import Outlined

__all__ = ["SelectionBar"]

Builder.load_string("""
<SelectionBar>:
    orientation: 'vertical'
    size_hint: None, None
    height: dp(52) + (said.height + dp(4) if root.trouble else 0)
    padding: dp(12), dp(6), dp(6), dp(6)
    rim: 'danger' if root.trouble else 'line'
    ground: 'surface'
    BoxLayout:
        id: row
        size_hint_y: None
        height: dp(40)
        spacing: dp(6)
        Text:
            text: root.text
            font_size: sp(15)
            shorten: True
            shorten_from: 'right'
            max_lines: 1
            pos_hint: {'center_y': .5}
    BoxLayout:
        size_hint_y: None
        height: said.height if root.trouble else 0
        opacity: 1 if root.trouble else 0
        spacing: dp(7)
        Icon:
            name: 'block'
            role: 'danger'
            font_size: sp(19)
            pos_hint: {'top': 1}
        Text:
            id: said
            text: root.trouble
            font_size: sp(14)
            pos_hint: {'top': 1}
""")


class SelectionBar(Outlined, BoxLayout):
    """What is selected on the map, and what can be done with it."""

    text = StringProperty("")
    trouble = StringProperty("")
    """Why the robot would refuse it, as one sentence; empty when it would not."""
