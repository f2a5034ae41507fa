"""What lays its children out."""

from typing import Any

from kivy.clock import ClockEvent
from kivy.uix.widget import Widget

class Layout(Widget):
    _trigger_layout: ClockEvent
    def do_layout(self, *args: Any) -> None: ...
    def layout_hint_with_bounds(
        self,
        sh_sum: float,
        available_space: float,
        min_bounded_size: float,
        sh_min_vals: Any,
        sh_max_vals: Any,
        hint: Any,
    ) -> None: ...
