"""Columns: widgets one below the other, or side by side, as high as they are together."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.gridlayout import GridLayout

__all__ = ["Column", "Grid"]

Builder.load_string("""
<Column>:
    orientation: 'vertical'
    size_hint_y: None
    height: self.minimum_height

<Grid>:
    size_hint_y: None
    height: self.minimum_height
""")


class Column(BoxLayout):
    """Its height is that of all that is in it."""


class Grid(GridLayout):
    """Its height is that of all its rows; what is lower than its row stands at the row's upper end."""

    def do_layout(self, *args: Any) -> None:
        """Kivy puts it at the row's lower end."""
        super().do_layout(*args)
        children, columns = self.children[::-1], self.cols or 1
        for first in range(0, len(children), columns):
            row = children[first : first + columns]
            top = max(child.top for child in row)
            for child in row:
                child.top = top
