"""Columns: widgets one below the other, or side by side, as high as they are together."""

from __future__ import annotations

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
    """Its height is that of all its rows."""
