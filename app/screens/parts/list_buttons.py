"""Buttons for a list and for the pane beside it: some below the list, others in a strip beside STOP."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from kivy.metrics import dp
from kivy.uix.gridlayout import GridLayout
from kivy.uix.widget import Widget

from app.layout.arrange import Rect
from widgets.core.theme import theme
from widgets.parts.kit import PrimaryButton, QuietButton

__all__ = ["Act", "ListButtons"]

MAX_SHARE_OF_STOP = 0.9
"""A button is at most as large as this share of STOP."""

Act = tuple[str, str, str, Callable[[], object]]
"""Name, words, icon, what a finger does with it."""


class ListButtons:
    """Every button by its name, and where each is just now."""

    def __init__(self, acts: Sequence[Act], primary: Sequence[str]) -> None:
        """Those of `primary` are the main thing to do where they are."""
        self.by_name: dict[str, Any] = {}
        self.under = GridLayout(cols=2, spacing=("8dp", "8dp"), size_hint_y=None)
        """The buttons below the list."""
        self._most = 0.0
        """The largest that a button may be [px²]."""
        self.under.bind(minimum_height=self.under.setter("height"))
        for name, text, icon, act in acts:
            button = (PrimaryButton if name in primary else QuietButton)(text=text, icon=icon)
            button.bind(on_release=lambda _, act=act: act())
            self.by_name[name] = button

    def lay(
        self, strip: GridLayout, names: Sequence[str], below: Sequence[str], *, form: str, stop: Rect
    ) -> None:
        """Put `names` into the strip and those `below` the list; a phone has none there.

        None is as large as STOP in its place [px], which is the largest thing to press.
        """
        tall, self._most = form == "tall", MAX_SHARE_OF_STOP * stop.width * stop.height
        strip.clear_widgets()
        self.under.clear_widgets()
        strip.cols = (2 if len(names) > 2 else 1) if tall else max(1, len(names))
        brief = len(names) > 2 or form == "short"
        for name in names:
            self._add(strip, name)
            self.by_name[name].flow = "vertical" if brief and not tall else "horizontal"
        self.under.cols = max(1, len(below))
        for name in below:
            self._add(self.under, name)
            button = self.by_name[name]
            button.size_hint_y, button.flow = None, "horizontal"
            button.height = max(dp(52), theme.least)
            button.size_hint_max_x = self._most / button.height
        self._fill(strip)

    def _add(self, parent: Widget, name: str) -> None:
        button = self.by_name[name]
        if button.parent is not None:
            button.parent.remove_widget(button)
        parent.add_widget(button)

    def _fill(self, strip: GridLayout) -> None:
        """Share the strip out, as high as it is where that makes no button too large."""
        rows = -(-len(strip.children) // strip.cols)
        gap = dp(8)
        across = (strip.width - gap * (strip.cols - 1)) / strip.cols
        high = (strip.height - gap * (rows - 1)) / max(1, rows)
        # a wide strip keeps its height, a narrow one its width
        fits = min(high, max(self._most / across, theme.least)) if strip.cols == 1 and across > 0 else high
        for button in strip.children:
            button.size_hint_y, button.height, button.size_hint_max_x = None, fits, self._most / fits
        strip.padding = [0, (strip.height - rows * fits - gap * (rows - 1)) / 2]
