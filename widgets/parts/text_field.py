"""Line of text to type into."""

from __future__ import annotations

from collections.abc import Callable

from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import dp, sp
from kivy.properties import AliasProperty, BooleanProperty, StringProperty
from kivy.uix.textinput import TextInput
from kivy.uix.widget import Widget

from widgets.core.base import text_texture
from widgets.core.icons import icon
from widgets.core.theme import theme

__all__ = ["TextField"]

Builder.load_string("""
<-TextField>:
    multiline: False
    size_hint_y: None
    height: theme.target
    font_name: theme.font
    font_size: theme.size_body
    padding: dp(14), (self.height - self.line_height) / 2 + root.drop, dp(46) if self.wrong else dp(14), (self.height - self.line_height) / 2 - root.drop
    foreground_color: theme.text
    hint_text_color: theme.muted
    cursor_color: theme.accent
    cursor_width: dp(2)
    selection_color: theme.accent[:3] + [.35]
    canvas.after:
        Color:
            rgba: theme.danger if root.wrong else (0, 0, 0, 0)
        Rectangle:
            texture: root.sign
            size: root.sign.size
            pos: self.right - dp(14) - root.sign.width, self.center_y - root.sign.height / 2
        Color:
            rgba: theme.muted if root.drop else (0, 0, 0, 0)
        Rectangle:
            texture: root.label_texture
            size: root.label_size  # kv does not see a texture's size change
            pos: self.x + dp(14), self.top - dp(5) - root.label_size[1]
    canvas.before:
        Rounded:
            rgba: theme.danger if root.wrong else theme.accent if root.focus else theme.line
            pos: self.pos
            size: self.size
            radius: [theme.corner]
        Rounded:
            rgba: theme.raised
            pos: self.x + dp(1.5), self.y + dp(1.5)
            size: self.width - dp(3), self.height - dp(3)
            radius: [theme.corner - dp(1.5)]
        Color:
            rgba: self.cursor_color if self.focus and not self._cursor_blink else (0, 0, 0, 0)
        Rectangle:
            pos: self._cursor_visual_pos
            size: root.cursor_width, -self._cursor_visual_height
        Color:
            rgba: self.foreground_color if self.text else self.hint_text_color
""")


class TextField(TextInput):
    """A line to type into; `wrong` while what it says cannot be used."""

    wrong = BooleanProperty(False)
    label = StringProperty("")
    """What is typed here, small over what was typed; before that the hint says it. Empty for none."""

    def _drop(self) -> float:
        return float(dp(8)) if self.label and self.text else 0.0

    drop = AliasProperty(_drop, bind=["label", "text"], cache=True)
    """How much lower than the middle the line is, to leave room for the label [px]."""

    def _label_texture(self) -> Texture:
        return text_texture(self.label, sp(12), theme.font)

    label_texture = AliasProperty(_label_texture, bind=["label"], cache=True)

    def _label_size(self) -> tuple[float, float]:
        return self.label_texture.size

    label_size = AliasProperty(_label_size, bind=["label_texture"], cache=True)
    """[px]"""

    def _sign(self) -> Texture:
        return text_texture(icon("error"), sp(22), theme.icons)

    sign = AliasProperty(_sign, cache=True)
    """What stands at its end while it is wrong."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Empty, filled, with a name, wrong."""
    wide = {"size_hint_x": None, "width": "330dp"}
    return {
        "empty": lambda: TextField(hint_text="Address, as in 192.168.1.7", **wide),
        "filled": lambda: TextField(text="192.168.1.7", **wide),
        "named": lambda: TextField(label="Message", text="For Ms. Weber, 2nd floor", **wide),
        "wrong": lambda: TextField(text="10.0.0.300", wrong=True, **wide),
    }
