"""Choosing numbers to plot: every number of every topic, searched by words, with those that are drawn marked."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from kivy.properties import ObjectProperty

from widgets.core.language import tr
from widgets.fields.number_fields import NumberField
from widgets.parts.cards import Card
from widgets.parts.kit import Column, IconButton, ListRow, Remark, Roll, Text, TextField

__all__ = ["FieldChooser"]

MAX_ROWS = 40
"""More are found by a narrower search."""

Key = tuple[str, str]
"""Topic and path."""


class FieldChooser(Card):
    """Dispatches `on_turn(topic, path, unit)` when a finger wants a number drawn or no longer, and `on_close`."""

    __events__ = ("on_turn", "on_close")

    drawn = ObjectProperty(frozenset())
    """Keys of what is drawn."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**{"orientation": "vertical", "padding": "12dp", "spacing": "8dp", **kwargs})
        self._fields: list[tuple[str, NumberField]] = []
        self.rows: dict[Key, ListRow] = {}
        """Those in sight."""
        self.search = TextField(hint_text=tr("Search fields"))
        self.search.bind(text=self._fill)
        self.column, self.more = Column(spacing="6dp"), Remark(role="muted")
        self._build()
        self.bind(drawn=self._mark)

    def _build(self) -> None:
        from kivy.uix.boxlayout import BoxLayout

        head = BoxLayout(size_hint_y=None, height="48dp", spacing="8dp")
        title = Text(text=tr("Plot a number"), bold=True, pos_hint={"center_y": 0.5})
        close = IconButton(icon="close", role="muted", bare=True, pos_hint={"center_y": 0.5})
        close.bind(on_release=lambda _: self.dispatch("on_close"))
        head.add_widget(title)
        head.add_widget(close)
        roll = Roll()
        roll.add_widget(self.column)
        for widget in (head, self.search, roll):
            self.add_widget(widget)

    def offer(self, fields: Iterable[tuple[str, NumberField]]) -> None:
        """Let one choose among these: topic and number."""
        self._fields = list(fields)
        self._fill()

    def _fill(self, *_: object) -> None:
        words = self.search.text.lower().split()
        found = [
            (topic, field)
            for topic, field in self._fields
            if all(word in f"{topic} {field.path}".lower() for word in words)
        ]
        found.sort(key=lambda one: (one[0], one[1].path) not in self.drawn)
        self.column.clear_widgets()
        self.rows = {}
        for topic, field in found[:MAX_ROWS]:
            row = ListRow(icon="timeline", title=field.path, detail=topic, aside=field.unit)
            row.bind(
                on_release=lambda _, topic=topic, field=field: self.dispatch(
                    "on_turn", topic, field.path, field.unit
                )
            )
            self.rows[topic, field.path] = row
            self.column.add_widget(row)
        over = len(found) - MAX_ROWS
        self.more.text = tr("{count} more: search for them.").format(count=over) if over > 0 else ""
        if not found:
            self.more.text = tr("No number is called so.")
        if self.more.text:
            self.column.add_widget(self.more)
        self._mark()

    def _mark(self, *_: object) -> None:
        for key, row in self.rows.items():
            row.chosen = key in self.drawn
            row.icon = "check_circle" if row.chosen else "timeline"

    def on_turn(self, topic: str, path: str, unit: str) -> None:
        """A finger pressed a number."""

    def on_close(self) -> None:
        """A finger closed it."""
