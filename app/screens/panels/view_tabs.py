"""Row of a profile's views, and the row of what can be done about them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.metrics import dp
from kivy.properties import BooleanProperty
from kivy.uix.behaviors import ButtonBehavior
from kivy.uix.gridlayout import GridLayout
from kivy.uix.label import Label
from kivy.uix.scrollview import ScrollView

from widgets.core.language import tr
from widgets.core.theme import theme
from widgets.parts.kit import PrimaryButton, PushButton, QuietButton

__all__ = ["Act", "ActRow", "ViewTabs"]

Act = tuple[str, str, str, bool, bool]
"""Name, words, icon, whether it can be done now, whether it is the main one."""

Builder.load_string("""
<ViewTabs>:
    do_scroll_y: False
    bar_width: 0
    scroll_type: ['content']
    BoxLayout:
        id: row
        size_hint_x: None
        width: self.minimum_width
        spacing: dp(4)

<ViewTab>:
    size_hint_x: None
    width: max(self.texture_size[0] + dp(30), theme.target)
    font_name: theme.font
    font_size: sp(16)
    bold: self.chosen
    color: theme.text if self.chosen else theme.muted
    disabled_color: self.color
    canvas.before:
        Rounded:
            rgba: theme.raised if self.chosen else (0, 0, 0, 0)
            pos: self.pos
            size: self.size
            radius: [theme.corner]
        Rounded:
            rgba: theme.accent if self.chosen else (0, 0, 0, 0)
            pos: self.x + dp(14), self.y
            size: self.width - dp(28), dp(3)
            radius: [dp(1.5)]
""")


NEW_VIEW = 132
"""Width of the button for another view [dp]."""


class ViewTab(ButtonBehavior, Label):
    """One view."""

    chosen = BooleanProperty(False)


class ViewTabs(ScrollView):
    """Dispatches `on_choose(index)`, and `on_add` for a new one."""

    __events__ = ("on_choose", "on_add")

    def __init__(self, **kwargs: Any) -> None:
        self._shown: object = None
        super().__init__(**kwargs)

    def show(self, titles: Sequence[str], chosen: int, *, editing: bool) -> None:
        """The views by their names; while they are edited a new one can be added."""
        shown = (tuple(titles), chosen, editing, theme.target)
        if shown == self._shown:
            return
        self._shown = shown
        row = self.ids.row
        row.clear_widgets()
        for index, title in enumerate(titles):
            tab = ViewTab(text=title, chosen=index == chosen)
            tab.bind(on_release=lambda _, index=index: self.dispatch("on_choose", index))
            row.add_widget(tab)
        if editing:
            more = QuietButton(
                text=tr("New view"), icon="add", size_hint_x=None, size_hint_y=1, width=dp(NEW_VIEW)
            )
            more.bind(on_release=lambda _: self.dispatch("on_add"))
            row.add_widget(more)

    def on_choose(self, index: int) -> None:
        """A finger chose a view."""

    def on_add(self) -> None:
        """A finger wants another view."""


NARROW = 180
"""Less width holds one button beside none [dp]."""


class ActRow(GridLayout):
    """Buttons side by side, in two rows where there is little width; dispatches `on_act(name)`."""

    __events__ = ("on_act",)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"rows": 1, "spacing": "8dp", **kwargs})
        self.buttons: dict[str, PushButton] = {}
        """By what they do."""
        self._names: tuple[object, ...] = ()

    def show(self, acts: Sequence[Act], form: str) -> None:
        """What can be done now."""
        names = (form, self._narrow, *((name, words, icon) for name, words, icon, _, _ in acts))
        if names != self._names:
            self._names = names
            self._make(acts, form)
        for name, _, _, able, _ in acts:
            self.buttons[name].disabled = not able

    @property
    def _narrow(self) -> bool:
        """There is room for one button side by side."""
        return bool(self.width < dp(NARROW))

    def _make(self, acts: Sequence[Act], form: str) -> None:
        self.clear_widgets()
        if form == "wide":
            self.rows = 1
        elif form == "short":
            self.rows = len(acts) if self._narrow else (len(acts) + 1) // 2
        else:
            self.rows = min(len(acts), 2)
        for name, words, icon, _, main in acts:
            button = (PrimaryButton if main else QuietButton)(text=words, icon=icon, size_hint_y=1)
            button.padding = (dp(6), 0)
            if form == "tall" and len(acts) > 2:
                button.flow = "vertical"
            button.bind(on_release=lambda _, name=name: self.dispatch("on_act", name))
            self.buttons[name] = button
            self.add_widget(button)

    def on_act(self, name: str) -> None:
        """A button was pressed."""
