"""Rows in a column that scrolls, or a sentence where there are none: the base of lists of one kind of thing.

class MissionList(Listing):
    def _build(self, *_): self.fill(self._row(mission) for mission in self.missions)
"""

from __future__ import annotations

from collections.abc import Iterable

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.rows  # noqa: F401 - its rules draw what scrolls
from widgets.core.base import Control
from widgets.core.language import tr
from widgets.parts.labels import Text

__all__ = ["Listing"]

Builder.load_string("""
<Listing>:
    orientation: 'vertical'
    spacing: dp(6)
    Roll:
        Column:
            id: column
            spacing: root.spacing
""")


class Listing(Control, BoxLayout):
    """A list that is filled as a whole."""

    nothing = StringProperty("")
    """What to say while there are no rows."""

    def fill(self, rows: Iterable[Widget]) -> None:
        """Show these in place of those before."""
        column = self.ids.column
        column.clear_widgets()
        for row in rows:
            column.add_widget(row)
        if not column.children:
            column.add_widget(Text(text=tr(self.nothing), role="muted", font_size="15sp"))
