"""Questions over everything else: one card on a shade, answered or cancelled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.floatlayout import FloatLayout

import widgets.kit  # noqa: F401 - its rules draw what is used here

__all__ = ["AddressDialog", "Question"]

Builder.load_string("""
<Question>:
    canvas.before:
        Color:
            rgba: theme.shade[:3] + [.6]
        Rectangle:
            pos: self.pos
            size: self.size

<AddressDialog>:
    Card:
        id: card
        size_hint: None, None
        width: min(dp(440), root.width - dp(28))
        height: self.minimum_height
        pos_hint: {'center_x': .5}
        top: root.top - max(dp(40), min(root.height * .28, dp(180)))
        padding: dp(20)
        spacing: dp(14)
        Text:
            text: 'Add a robot by its address'
            bold: True
            font_size: theme.size_title
        TextField:
            id: field
            hint_text: '192.168.1.7'
            wrong: bool(root.problem)
            input_type: 'url'
            on_text: root.problem = ''
            on_text_validate: root.answer()
        Text:
            text: root.problem or 'The port is 9090 unless it is given, as in 192.168.1.7:9091.'
            role: 'danger' if root.problem else 'muted'
            font_size: sp(14)
        BoxLayout:
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: cancel
                text: 'Cancel'
                on_release: root.close()
            PrimaryButton:
                id: connect
                text: 'Connect'
                on_release: root.answer()
""")


class Question(FloatLayout):
    """Lies over everything else until it is answered or cancelled; its rule has a `card`."""

    __events__ = ("on_close",)

    def close(self) -> None:
        """Leave the glass."""
        if self.parent is not None:
            self.parent.remove_widget(self)
            self.dispatch("on_close")

    def on_close(self) -> None:
        """It was answered or cancelled."""

    def on_touch_down(self, touch: Any) -> bool:
        """Nothing behind the question gets a finger; one beside the card cancels."""
        if not self.ids.card.collide_point(*touch.pos):
            self.close()
        else:
            super().on_touch_down(touch)
        return True


class AddressDialog(Question):
    """Asks for an address; `on_answer` may raise ValueError, whose sentence is shown, and what was typed stays."""

    problem = StringProperty("")

    def __init__(self, on_answer: Callable[[str], object], **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._on_answer = on_answer

    def answer(self) -> None:
        """Hand over what was typed; stays open when it is wrong."""
        try:
            self._on_answer(self.ids.field.text)
        except ValueError as error:
            self.problem = str(error)
        else:
            self.close()

    def close(self) -> None:
        """Leave the glass, and the keyboard with it."""
        self.ids.field.focus = False
        super().close()
