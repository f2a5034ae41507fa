"""What panes of the setup screen have in common: a column that scrolls, headings, sentences, and a list to choose one of."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from kivy.properties import ObjectProperty
from kivy.uix.widget import Widget

from widgets.parts.kit import Column, ListRow, Remark, Roll, SectionLabel, Toggle

__all__ = ["Choices", "SettingsPane", "SwitchRow", "switch_row"]

CHOSEN, OTHER = "radio_button_checked", "radio_button_unchecked"


class Choices(Column):
    """One of several, below each other, each with a second line; dispatches `on_choose(value)` when a finger takes another."""

    __events__ = ("on_choose",)

    def __init__(self, options: Mapping[Any, tuple[str, str]], value: Any, **kwargs: Any) -> None:
        """`options` are value to title and second line, in their order."""
        super().__init__(spacing="6dp", **kwargs)
        self.rows: dict[Any, ListRow] = {}
        for one, (title, detail) in options.items():
            row = self.rows[one] = ListRow(title=title, detail=detail, whole=True)
            row.bind(on_release=lambda _, one=one: self._choose(one))
            self.add_widget(row)
        self.show(value)

    def show(self, value: Any) -> None:
        """Mark the chosen one."""
        self.value = value
        for one, row in self.rows.items():
            row.chosen = one == value
            row.icon, row.role = (CHOSEN, "accent") if one == value else (OTHER, "muted")

    def _choose(self, value: Any) -> None:
        if value != self.value:
            self.show(value)
            self.dispatch("on_choose", value)

    def on_choose(self, value: Any) -> None:
        """A finger took another one."""


class SwitchRow(ListRow):
    """A row with its `switch`."""

    switch: Toggle


def switch_row(icon: str, title: str, detail: str, *, on: bool, take: Callable[[bool], object]) -> SwitchRow:
    """A row with a switch, which a finger on the row turns as well; `take` is told how it stands then."""
    row, toggle = SwitchRow(icon=icon, title=title, detail=detail, whole=True), Toggle(active=on)
    toggle.pos_hint = {"center_y": 0.5}
    row.add_widget(toggle)
    row.switch = toggle
    toggle.bind(on_change=lambda _, on: take(on))

    def turned(_: Any) -> None:
        toggle.active = not toggle.active
        take(toggle.active)

    row.bind(on_release=turned)
    return row


class SettingsPane(Roll):
    """A pane of one column; `fill` makes what is in it."""

    app = ObjectProperty()

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.column = Column(spacing="8dp", padding=(0, "2dp", "8dp", "12dp"))
        self.add_widget(self.column)
        for widget in self.fill():
            self.column.add_widget(widget)

    def fill(self) -> Iterable[Widget]:
        """What is in it, from above."""
        raise NotImplementedError

    def heading(self, words: str) -> SectionLabel:
        """The name over what follows."""
        return SectionLabel(title=words, size_hint_y=None)

    def remark(self, words: str) -> Remark:
        """A sentence."""
        return Remark(text=words, font_size="15sp")

    def enter(self) -> None:
        """Come onto the glass."""

    def leave(self) -> None:
        """Leave the glass."""

    def tick(self) -> None:
        """Bring up to date what time changes."""
