"""The upper end of what stands beside a list, or on a phone in its place: a title, one sentence, the way back."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty

from widgets.parts.column import Column
from widgets.parts.kit import IconButton

__all__ = ["PaneHead"]

Builder.load_string("""
<PaneHead>:
    spacing: dp(8)
    BoxLayout:
        id: line
        size_hint_y: None
        height: max(dp(48), title.height, theme.least if root.closable else 0)
        spacing: dp(6)
        Text:
            id: title
            text: root.title
            bold: True
            font_size: theme.size_title
            pos_hint: {'center_y': .5}
    Remark:
        text: root.sentence
        role: 'danger' if root.refused else 'muted'
        font_size: sp(15)
""")


class PaneHead(Column):
    """Dispatches `on_close`."""

    __events__ = ("on_close",)

    title = StringProperty("")
    sentence = StringProperty("")
    """Empty for none."""
    refused = BooleanProperty(False)
    """The sentence says why the robot would refuse what is below."""
    closable = BooleanProperty(False)
    """Has the way back."""

    def __init__(self, **kwargs: Any) -> None:
        self._back = IconButton(icon="arrow_back", bare=True, pos_hint={"center_y": 0.5})
        super().__init__(**kwargs)
        self._line = self.ids.line.__self__  # kv holds ids weakly
        self._back.bind(on_release=lambda _: self.dispatch("on_close"))
        self.bind(closable=self._lay)
        self._lay()

    def _lay(self, *_: object) -> None:
        if self.closable == (self._back.parent is self._line):
            return
        if self.closable:
            self._line.add_widget(self._back, index=len(self._line.children))
        else:
            self._line.remove_widget(self._back)

    def on_close(self) -> None:
        """A finger asked to go back."""
