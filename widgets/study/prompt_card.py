"""Prompt of a trial, to be read from an arm's length while walking.

card = PromptCard(icon="pause", words="Pause", how="Say it", share=0.4)
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.widget import Widget

import widgets.parts.labels
import widgets.parts.sliders  # noqa: F401 - its rules draw what is used here
from widgets.core.surfaces import Outlined
from widgets.parts.column import Column

__all__ = ["PromptCard", "samples"]

Builder.load_string("""
<PromptCard>:
    padding: dp(14), dp(14), dp(14), dp(14)
    spacing: dp(10)
    rim: 'accent' if root.asking else 'line'
    rim_width: dp(3) if root.asking else dp(1)
    ground: 'surface'
    corner: theme.radius
    BoxLayout:
        size_hint_y: None
        height: dp(74)
        padding: max(0, (self.width - sign.width - words.texture_size[0] - self.spacing) / 2), 0, 0, 0
        spacing: dp(14) if root.asking else 0
        Icon:
            id: sign
            name: root.icon if root.asking else 'more_horiz'
            role: 'accent' if root.asking else 'muted'
            font_size: sp(56)
            pos_hint: {'center_y': .5}
        Label:
            id: words
            text: root.words if root.asking else ''
            font_name: theme.font
            font_size: sp(root.type_size)
            bold: True
            color: theme.text
            disabled_color: self.color
            size_hint: None, None
            size: self.texture_size
            pos_hint: {'center_y': .5}
    Text:
        text: root.how
        halign: 'center'
        font_size: sp(17)
    Progress:
        value: root.share
    BoxLayout:
        size_hint_y: None
        height: max(left.height, right.height)
        Text:
            id: left
            text: root.last
            role: 'muted'
            font_size: sp(15)
        Text:
            id: right
            text: root.counted
            role: 'muted'
            font_size: sp(15)
            halign: 'right'
            size_hint_x: None
            width: dp(84)
""")


class PromptCard(Outlined, Column):
    """One command to give, how, and how far all of it has come."""

    icon = StringProperty("check")
    words = StringProperty("")
    """The command."""
    how = StringProperty("")
    """By which method, or what comes next."""
    asking = BooleanProperty(True)
    """It is asked for just now; else it is waited for the next."""
    last = StringProperty("")
    """What became of the one before."""
    counted = StringProperty("")
    """How many of how many, as in `12 of 50`."""
    share = NumericProperty(0.0)
    """Of all prompts, 0 to 1."""

    def _type_size(self) -> float:
        if self.width >= dp(420):
            return 36.0
        return 27.0 if self.width >= dp(300) or len(self.words) < 9 else 21.0

    type_size = AliasProperty(_type_size, bind=["width", "words"], cache=True)
    """Of the words [sp]."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Asking, waiting, long words on a narrow glass."""

    def made(width: float = 460, **kwargs: Any) -> Callable[[], Widget]:
        given = {
            "icon": "pause",
            "words": "Pause",
            "how": "Voice: say it",
            "counted": "12 of 50",
            "share": 0.24,
        }
        return lambda: PromptCard(size_hint=(None, None), width=dp(width), **{**given, **kwargs})

    return {
        "asking": made(last="Understood."),
        "waiting": made(asking=False, how="Wait for the next one.", last="Nothing was understood."),
        "narrow": made(320, words="End the task", icon="cancel", how="Switches: choose it below"),
    }
