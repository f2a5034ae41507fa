"""The whole glass: one page, at times a question over it, and over everything what must always be reached."""

from __future__ import annotations

from typing import Any

from kivy.clock import Clock
from kivy.core.window import Window
from kivy.metrics import Metrics
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.widget import Widget

from app.device import is_android
from app.device.insets import insets
from app.screens.parts.safe_area import safe_area
from widgets.core.theme import theme

__all__ = ["Root"]

EDGES_PERIOD = 1.0
"""Between two looks at where a phone's edges are [s]."""


class Root(FloatLayout):
    """What the window shows."""

    over: Widget | None = None
    """Stays on top of whatever is added."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        theme.bind(bg=self._lay_ground)
        self.bind(size=self.find_edges)
        self._lay_ground()
        self.find_edges()
        if is_android():  # a phone turned upside down keeps the window's size and moves its camera
            Clock.schedule_interval(self.find_edges, EDGES_PERIOD)

    def find_edges(self, *_: object) -> None:
        """Have every page keep clear of what a phone's camera, corners and bars take of the glass."""
        safe_area.insets = insets(Metrics.density)

    def _lay_ground(self, *_: object) -> None:
        """Have the window begin each frame in the theme's colour: no page draws a ground that its picture then covers."""
        Window.clearcolor = theme.bg
        Window.canvas.ask_update()

    def add_widget(self, widget: Widget, *args: Any, **kwargs: Any) -> None:
        """Put it on top, but below `over`."""
        super().add_widget(widget, *args, **kwargs)
        if self.over is not None and widget is not self.over:
            self.remove_widget(self.over)
            super().add_widget(self.over)

    def show_page(self, page: Any) -> None:
        """Put a page in the place of the one before."""
        self.clear_widgets()
        self.add_widget(page)
