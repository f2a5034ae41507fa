"""The way to the inputs screen: a chip that shows by icons which methods are armed, and which of them does not work."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from kivy.lang import Builder
from kivy.properties import BooleanProperty, ListProperty
from kivy.uix.boxlayout import BoxLayout

from app.screens.inputs import PANES
from widgets.frames import Pressable
from widgets.kit import Icon
from widgets.theme import theme

__all__ = ["InputsChip"]

NOTHING = "tune"
"""Icon while no method is armed."""
MOST = 4
"""So many icons are shown, on a brief one the first alone."""

Builder.load_string("""
<InputsChip>:
    size_hint: None, None
    size: self.minimum_width, dp(34)
    padding: dp(9), 0
    spacing: dp(6)
    rim: 'line'
    ground: 'raised'
    corner: self.height / 2
""")


class InputsChip(Pressable, BoxLayout):
    """Dispatches `on_release`."""

    brief = BooleanProperty(False)
    """It has room for one icon."""
    methods = ListProperty()
    """Name of each method that is armed, and whether it is well."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.bind(methods=self._draw, brief=self._draw)
        self._draw()

    def show(self, methods: Sequence[tuple[str, bool]]) -> None:
        """Take over which methods are armed."""
        self.methods = list(methods)

    def _draw(self, *_: object) -> None:
        self.clear_widgets()
        # what does not work goes before what does: it must not be the one that has no room
        told = sorted((one for one in self.methods if one[0] in PANES), key=self._rank)
        shown = told[: 1 if self.brief else MOST]
        for name, well in shown or [("", True)]:
            icon = PANES[name][0] if name else NOTHING
            role = "muted" if not name else "accent" if well else "warn"
            self.add_widget(Icon(name=icon, role=role, font_size="20sp", pos_hint={"center_y": 0.5}))

    def _rank(self, one: tuple[str, bool]) -> tuple[bool, int]:
        return one[1], list(PANES).index(one[0])

    def collide_point(self, x: float, y: float) -> bool:
        """It is hit within a whole target round it."""
        up, across = max(0.0, theme.target - self.height) / 2, max(0.0, theme.target - self.width) / 2
        return bool(self.x - across <= x <= self.right + across and self.y - up <= y <= self.top + up)
