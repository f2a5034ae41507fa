"""A list of what a key or a button can do, to choose one from."""

from __future__ import annotations

from typing import Any

from kivy.uix.boxlayout import BoxLayout

from app.inputs.binding_actions import MEANINGS
from app.screens.parts.pane_head import PaneHead
from widgets.core.language import mark, tr
from widgets.parts.kit import Column, ListRow, Roll

__all__ = ["MeaningList"]

NOTHING = (mark("Nothing"), "block")


class MeaningList(BoxLayout):
    """Dispatches `on_choose(name)` with a key of `MEANINGS` or another choice, empty for nothing, and `on_close`."""

    __events__ = ("on_choose", "on_close")

    def __init__(self, choices: dict[str, tuple[str, str]] | None = None, **kwargs: Any) -> None:
        """`choices` are other ones than `MEANINGS`, by name, with words and icon."""
        super().__init__(orientation="vertical", spacing="8dp", **kwargs)
        self.head = PaneHead(closable=True)
        self.head.bind(on_close=lambda _: self.dispatch("on_close"))
        self.rows: dict[str, ListRow] = {}
        self._column = Column(spacing="6dp")
        roll = Roll()
        roll.add_widget(self._column)
        self.add_widget(self.head)
        self.add_widget(roll)
        for name, (words, icon) in (choices or {"": NOTHING, **MEANINGS}).items():
            row = self.rows[name] = ListRow(icon=icon, title=tr(words))
            row.bind(on_release=lambda _, name=name: self.dispatch("on_choose", name))
            self._column.add_widget(row)

    def ask(self, title: str, sentence: str, chosen: str) -> None:
        """Ask what `title` shall mean; `chosen` is what it means now."""
        self.head.title, self.head.sentence, self.head.refused = title, sentence, False
        for name, row in self.rows.items():
            row.chosen = name == chosen

    def refuse(self, sentence: str) -> None:
        """Say why what was chosen cannot be."""
        self.head.sentence, self.head.refused = sentence, True

    def on_choose(self, name: str) -> None:
        """A finger chose."""

    def on_close(self) -> None:
        """A finger asked to go back."""
