"""Notice over every screen until it is dealt with: an icon, a headline, a sentence, and what can be done about it.

class AlarmCard(NoticeCard):
    def show(self, msg): self.headline, self.said = "Alarm", msg.text
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import AliasProperty, BooleanProperty, NumericProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.labels  # noqa: F401 - its rules draw what is used here
from widgets.core.base import Control
from widgets.core.surfaces import Outlined
from widgets.core.theme import theme
from widgets.parts.buttons import IconButton, PrimaryButton, PushButton, QuietButton
from widgets.parts.column import Column

__all__ = ["NoticeCard"]

COMPACT, TINY = 400.0, 340.0
"""Narrower ones leave out their icons, and what can be spared [dp]."""

Builder.load_string("""
<NoticeCard>:
    padding: dp(14), dp(6) if root.tiny else dp(9)
    spacing: dp(7) if root.tiny else dp(10)
    rim: root.role
    ground: 'surface'
    corner: theme.radius
    rim_width: dp(2)
    BoxLayout:
        id: row
        size_hint_y: None
        height: max(words.height, dp(34), root.beside)
        spacing: dp(10)
        Icon:
            id: sign
            name: root.icon
            role: root.role
            font_size: sp(28)
            pos_hint: {'center_y': .5}
        Column:
            id: words
            spacing: dp(2)
            pos_hint: {'center_y': .5}
            Text:
                text: root.headline
                bold: True
                font_size: sp(18)
            Remark:
                text: root.said
                font_size: sp(14.5)
""")


class NoticeCard(Outlined, Control, Column):
    """A card with room for buttons: beside its words by `add_beside`, below them by `add_below`."""

    veiled = False

    headline = StringProperty("")
    said = StringProperty("")
    """One sentence more; empty for none."""
    icon = StringProperty("info")
    """Name of the icon."""
    role = StringProperty("accent")
    """Role of the icon and the border."""
    open = BooleanProperty(False)
    """There is something to deal with."""
    blocked = BooleanProperty(False)
    """No action is permitted here now."""

    beside = NumericProperty(0.0)
    """Height of what stands beside the words [px]."""

    def _tiny(self) -> bool:
        return bool(self.width < dp(TINY))

    tiny = AliasProperty(_tiny, bind=["width"], cache=True)
    """There is no room for a cross, nor for more than the headline and the sentence."""

    def _compact(self) -> bool:
        return bool(self.width < dp(COMPACT) and self.beside)

    compact = AliasProperty(_compact, bind=["width", "beside"], cache=True)
    """The words need the room of the icons, since something stands beside them."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._sign = self.ids.sign.__self__  # kv holds ids weakly, and a compact card takes this one out
        self.fbind("compact", self._signed)
        self._signed()

    def _signed(self, *_: object) -> None:
        row, sign = self.ids.row, self._sign
        if self.compact and sign.parent is not None:
            row.remove_widget(sign)
        elif not self.compact and sign.parent is None:
            row.add_widget(sign, index=len(row.children))

    def add_beside(self, text: str, icon: str) -> PushButton:
        """A quiet button right of the words; what stands on it can be changed by `relabel`."""
        self._button = QuietButton(size_hint_x=None, pos_hint={"center_y": 0.5})
        self.fbind("compact", lambda *_: self.relabel(*self._label))
        self.relabel(text, icon)
        self._reserve(self._button)
        return self._button

    def relabel(self, text: str, icon: str) -> None:
        """Change what stands on the button beside the words."""
        button, self._label = self._button, (text, icon)
        button.text, button.icon = text, "" if self.compact else icon
        button.width, button.padding = (dp(108), [dp(6), 0]) if self.compact else (dp(136), [dp(10), 0])

    def add_close(self) -> Widget:
        """A cross that takes the card away; dispatches `on_command("close")`. A tiny card has none."""
        cross = IconButton(icon="close", role="muted", bare=True, pos_hint={"center_y": 0.5})
        cross.bind(on_release=lambda _: self.dispatch("on_command", "close"))
        self._reserve(cross)
        self.fbind("tiny", lambda *_: self._crossed(cross))
        self._crossed(cross)
        return cross

    def _crossed(self, cross: Widget) -> None:
        if self.tiny and cross.parent is not None:
            self.ids.row.remove_widget(cross)
        elif not self.tiny and cross.parent is None:
            self.ids.row.add_widget(cross)
        self._fit()

    def _reserve(self, button: Widget) -> None:
        self.ids.row.add_widget(button)
        button.bind(height=self._fit)
        self._fit()

    def _fit(self, *_: object) -> None:
        buttons = (PushButton, IconButton)
        self.beside = max(
            (one.height for one in self.ids.row.children if isinstance(one, buttons)), default=0
        )

    def add_below(self, *buttons: tuple[str, str, bool]) -> list[PushButton]:
        """A row of large buttons, each `(text, icon, primary)`."""
        row = BoxLayout(size_hint_y=None, height=dp(60), spacing=dp(10))

        def fit(*_: object) -> None:
            row.height = theme.target if self.tiny else dp(60)

        self.fbind("tiny", fit)
        fit()
        made: list[PushButton] = []
        for text, icon, primary in buttons:
            kind = PrimaryButton if primary else QuietButton
            made.append(kind(text=text, icon=icon, size_hint_y=1))
            row.add_widget(made[-1])
        self.add_widget(row)
        return made


def samples() -> dict[str, Callable[[], Widget]]:
    """With words alone, and with a button beside them and others below."""

    def make(**kwargs: Any) -> NoticeCard:
        return NoticeCard(
            headline="The gate is shut", said="It opens at six.", size_hint_x=None, width="420dp", **kwargs
        )

    def full() -> Widget:
        card = make(icon="lock", role="warn")
        card.add_beside("Open", "lock_open")
        card.add_below(("Wait", "timer", False), ("Go round", "arrow_forward", True))
        return card

    return {"words": make, "buttons": full}
