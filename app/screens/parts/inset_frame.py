"""What lies over a small map or picture: a tap makes it large and the other one small."""

from __future__ import annotations

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.anchorlayout import AnchorLayout
from kivy.uix.behaviors import ButtonBehavior

__all__ = ["InsetFrame"]

Builder.load_string("""
<InsetFrame>:
    anchor_x: 'right'
    anchor_y: 'bottom'
    padding: dp(4)
    canvas.after:
        Color:
            rgba: theme.accent if self.state == 'down' else theme.line
        Line:
            rectangle: self.x, self.y, self.width, self.height
            width: dp(1.2)
    Icon:
        name: 'fullscreen'
        role: 'text'
        size_hint: None, None
        size: dp(24), dp(24)
""")


class InsetFrame(ButtonBehavior, AnchorLayout):
    """Lies over what is small; a tap on it swaps."""

    scan_words = StringProperty("")
    """What a press does, for whoever does not see it."""
