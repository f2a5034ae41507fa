"""The whole glass: one page, at times a question over it, and over everything what must always be reached."""

from __future__ import annotations

from typing import Any

from kivy.uix.floatlayout import FloatLayout
from kivy.uix.widget import Widget

__all__ = ["Root"]


class Root(FloatLayout):
    """What the window shows."""

    over: Widget | None = None
    """Stays on top of whatever is added."""

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
