"""The buttons of a layout that float beside STOP: of what the robot has something for, and of what it carries."""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock
from kivy.metrics import Metrics, sp
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from app.layout.layout import Layout
from app.session.layout_actions import CARRIED, LayoutActions
from widgets.controls.action_column import Action
from widgets.core.language import tr
from widgets.parts.kit import Card, QuietButton, Text
from widgets.parts.sensor_card import wide

__all__ = ["ActionButtons"]

NARROW = 110
"""On a narrower button the icon is above the word [dp]."""
MAX_IN_ROW = 3
"""So many above each other have room for a finger; of more some are on the glass, and a button turns to the next."""
MIN_WIDTH = 88
"""Width that a button in a row needs [dp]."""
ICON = 32
"""Taken by the icon beside the words [dp]."""
SMALLEST = 13.5
"""How things stand is said behind the words where both can be as large as this [sp]."""
FIRST = 8.0
"""So long after the last turn the first ones are on the glass again [s]."""
TASKS = ("pause", "task.")
"""How actions begin that a robot without tasks has not."""


class ActionButtons(GridLayout):
    """One above the other, or in a row where they are `across`."""

    def __init__(self, layout: Layout, actions: LayoutActions, **kwargs: Any) -> None:
        super().__init__(**{"cols": 1, "spacing": "10dp", **kwargs})
        self._actions = actions
        self.across = False
        """They are in a row."""
        self.buttons: dict[str, QuietButton] = {}
        """By what they do, in the order of the layout."""
        for what in dict.fromkeys((*(one.what for one in layout.actions), *CARRIED)):
            button = QuietButton(size_hint_y=1)
            button.bind(on_release=lambda _, what=what: actions.act(what))
            self.buttons[what] = button
        self.more = QuietButton(size_hint_y=1, text=tr("More"), icon="more_horiz")
        """Turns to those that have no room."""
        self.more.bind(on_release=lambda _: self._turn())
        self._page = 0
        self._turn_back = Clock.create_trigger(lambda _: self._turn(to=0), FIRST)
        self.bind(size=lambda *_: self._flow())
        self._note = Card(floating=True, padding=("6dp", "2dp"))
        note = Text(text=tr("It offers no tasks."), role="muted", font_size="14sp", halign="center")
        note.size_hint_y, note.valign = 1, "middle"
        note.bind(size=note.setter("text_size"))
        self._note.add_widget(note)
        self.tick()

    def tick(self) -> None:
        """Bring up to date which there are and what each does now."""
        found = {action.name: action for action in self._actions.current() if action.name in self.buttons}
        for name, action in found.items():
            button = self.buttons[name]
            button.text, button.icon, button.disabled = self._words(action), action.icon, not action.able
            button.meaning = action.meaning or action.text
        wanted: list[Widget] = self._fitting([name for name in self.buttons if name in found])
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

    def _fitting(self, names: list[str]) -> list[Widget]:
        """The buttons that have room; of more than that those of the page, what moves the robot on the first."""
        room = (
            max(MAX_IN_ROW, min(MAX_IN_ROW + 1, int(self.width // (MIN_WIDTH * Metrics.density))))
            if self.across
            else MAX_IN_ROW
        )
        if len(names) <= room:
            return [self.buttons[name] for name in names]
        names = sorted(names, key=lambda name: not name.startswith(TASKS))
        pages = -(-len(names) // (room - 1))
        first = min(self._page % pages * (room - 1), len(names) - room + 1)
        return [*(self.buttons[name] for name in names[first : first + room - 1]), self.more]

    def _turn(self, to: int | None = None) -> None:
        """Show the next ones, after the last the first."""
        self._turn_back.cancel()
        self._page = self._page + 1 if to is None else to
        if to is None:
            self._turn_back()
        self.tick()

    def _words(self, action: Action) -> str:
        """What it does, and how that stands where there is room for both."""
        both = f"{action.text} · {action.said}"
        across = (
            self.width / max(1, len(self.children)) if self.across else self.width - ICON * Metrics.density
        )
        fits = action.said and wide(both, sp(SMALLEST), bold=True) <= across - 20 * Metrics.density
        return both if fits else action.text

    def _flow(self) -> None:
        count = max(1, len(self.children))
        self.cols = count if self.across else 1
        narrow = self.across and self.width < NARROW * Metrics.density * count
        for button in (*self.buttons.values(), self.more):
            button.flow = "vertical" if narrow else "horizontal"
            button.padding = (4 * Metrics.density, 0) if narrow else (10 * Metrics.density, 0)
