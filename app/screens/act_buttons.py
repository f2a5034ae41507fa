"""What can be done about a list and about what is beside it: buttons below the list, and a strip beside STOP."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from widgets.kit import PrimaryButton, QuietButton

__all__ = ["Act", "ActButtons"]

Act = tuple[str, str, str, Callable[[], object]]
"""Name, words, icon, what a finger does with it."""


class ActButtons:
    """Every button by its name, and where each is just now."""

    def __init__(self, acts: Sequence[Act], primary: Sequence[str]) -> None:
        """Those of `primary` are the main thing to do where they are."""
        self.by_name: dict[str, Any] = {}
        self.under = GridLayout(cols=2, spacing=("8dp", "8dp"), size_hint_y=None)
        """The buttons below the list."""
        self.under.bind(minimum_height=self.under.setter("height"))
        for name, text, icon, act in acts:
            button = (PrimaryButton if name in primary else QuietButton)(text=text, icon=icon)
            button.bind(on_release=lambda _, act=act: act())
            self.by_name[name] = button

    def lay(self, strip: GridLayout, names: Sequence[str], below: Sequence[str], *, form: str) -> None:
        """Put `names` into the strip and those `below` the list; a phone has none there."""
        tall = form == "tall"
        strip.clear_widgets()
        self.under.clear_widgets()
        strip.cols = (2 if len(names) > 2 else 1) if tall else max(1, len(names))
        brief = len(names) > 2 or form == "short"
        for name in names:
            self._add(strip, name, fixed=False)
            self.by_name[name].flow = "vertical" if brief and not tall else "horizontal"
        self.under.cols = max(1, len(below))
        for name in below:
            self._add(self.under, name, fixed=True)

    def _add(self, parent: Widget, name: str, *, fixed: bool) -> None:
        button = self.by_name[name]
        if button.parent is not None:
            button.parent.remove_widget(button)
        button.size_hint_y = None if fixed else 1
        if fixed:
            button.height, button.flow = "52dp", "horizontal"
        parent.add_widget(button)
