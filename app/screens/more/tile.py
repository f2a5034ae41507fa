"""A large button for a page of them: an icon, what it leads to, and a few words on that."""

from __future__ import annotations

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from widgets.core.surfaces import Pressable

__all__ = ["Tile"]

Builder.load_string("""
<Tile>:
    orientation: 'horizontal'
    size_hint_min_y: lines.height + dp(20)
    padding: dp(16), dp(10), dp(12), dp(10)
    spacing: dp(14)
    ground: 'surface'
    corner: theme.radius
    Icon:
        name: root.icon
        role: root.role
        font_size: sp(28)
        size_hint: None, None
        size: self.font_size, self.font_size
        pos_hint: {'center_y': .5}
    BoxLayout:
        id: lines
        orientation: 'vertical'
        size_hint_y: None
        height: self.minimum_height
        spacing: dp(2)
        pos_hint: {'center_y': .5}
        Text:
            id: words
            text: root.words
            bold: True
            font_size: sp(17)
        Remark:
            id: about
            text: root.about
            role: 'muted'
            font_size: sp(13.5)
""")


class Tile(Pressable, BoxLayout):
    """Dispatches `on_release`."""

    icon = StringProperty("more_horiz")
    role = StringProperty("accent")
    """Role of the icon's colour."""
    words = StringProperty("")
    about = StringProperty("")
    """Empty for none."""
