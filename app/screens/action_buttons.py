"""The buttons of a layout that float beside STOP: as many as the robot has something for."""

from __future__ import annotations

from typing import Any

from kivy.metrics import Metrics
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from app.actions import Actions
from app.layout import Layout
from widgets.kit import Card, QuietButton, Text

__all__ = ["ActionButtons"]

NARROW = 110
"""On a narrower button the icon is above the word [dp]."""
MOST = 3
"""So many have room for a finger: of a robot that has something for more the layout's first ones are on the glass."""
TASKS = ("pause", "task.")
"""How actions begin that a robot without tasks has not."""


class ActionButtons(GridLayout):
    """One above the other, or in a row where they are `across`."""

    def __init__(self, layout: Layout, actions: Actions, **kwargs: Any) -> None:
        super().__init__(**{"cols": 1, "spacing": "10dp", **kwargs})
        self._actions = actions
        self.across = False
        """They are in a row."""
        self.buttons: dict[str, QuietButton] = {}
        """By what they do, in the order of the layout."""
        for one in layout.actions:
            button = QuietButton(size_hint_y=1)
            button.bind(on_release=lambda _, what=one.what: actions.act(what))
            self.buttons[one.what] = button
        self.bind(size=lambda *_: self._flow())
        self._note = Card(floating=True, padding=("6dp", "2dp"))
        note = Text(text="It offers no tasks.", role="muted", font_size="14sp", halign="center")
        note.size_hint_y, note.valign = 1, "middle"
        note.bind(size=note.setter("text_size"))
        self._note.add_widget(note)
        self.tick()

    def tick(self) -> None:
        """Bring up to date which there are and what each does now."""
        found = {action.name: action for action in self._actions.look() if action.name in self.buttons}
        for name, action in found.items():
            button = self.buttons[name]
            button.text, button.icon, button.disabled = action.text, action.icon, not action.able
            button.meaning = action.meaning or action.text
        wanted: list[Widget] = [button for name, button in self.buttons.items() if name in found][:MOST]
        # instead of buttons that can never be pressed stands why
        if any(name.startswith(TASKS) for name in self.buttons) and not any(
            name.startswith(TASKS) for name in found
        ):
            wanted.append(self._note)
        if list(reversed(self.children)) != wanted:
            self.clear_widgets()
            for widget in wanted:
                self.add_widget(widget)
        self._flow()

    def _flow(self) -> None:
        count = max(1, len(self.children))
        self.cols = count if self.across else 1
        narrow = self.across and self.width < NARROW * Metrics.density * count
        for button in self.buttons.values():
            button.flow = "vertical" if narrow else "horizontal"
            button.padding = (4 * Metrics.density, 0) if narrow else (10 * Metrics.density, 0)
