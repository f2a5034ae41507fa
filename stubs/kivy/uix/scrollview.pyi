"""A window on something larger."""

from typing import Any

from kivy.input.motionevent import MotionEvent
from kivy.properties import (
    BooleanProperty,
    ColorProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    OptionProperty,
    Property,
)
from kivy.uix.widget import Widget

class ScrollView(Widget):
    scroll_distance: NumericProperty
    scroll_wheel_distance: NumericProperty
    scroll_timeout: NumericProperty
    scroll_x: NumericProperty
    scroll_y: NumericProperty
    do_scroll_x: BooleanProperty
    do_scroll_y: BooleanProperty
    do_scroll: Property[tuple[bool, bool], Any]
    always_overscroll: BooleanProperty
    vbar: Property[tuple[float, float], Any]
    hbar: Property[tuple[float, float], Any]
    bar_color: ColorProperty
    bar_inactive_color: ColorProperty
    bar_width: NumericProperty
    bar_margin: NumericProperty
    bar_pos_x: OptionProperty
    bar_pos_y: OptionProperty
    effect_cls: ObjectProperty
    effect_x: ObjectProperty
    effect_y: ObjectProperty
    viewport_size: ListProperty[float]
    scroll_type: OptionProperty[list[str]]
    smooth_scroll_end: ObjectProperty[float | None]
    _viewport: ObjectProperty
    _touch: MotionEvent | None
    def on_scroll_start(self, touch: MotionEvent, check_children: bool = True) -> bool | None: ...
    def on_scroll_move(self, touch: MotionEvent) -> bool | None: ...
    def on_scroll_stop(self, touch: MotionEvent, check_children: bool = True) -> bool | None: ...
    def scroll_to(self, widget: Widget, padding: Any = 10, animate: Any = True) -> None: ...
    def convert_distance_to_scroll(self, dx: float, dy: float) -> tuple[float, float]: ...
    def update_from_scroll(self, *args: Any) -> None: ...
    def _update_effect_bounds(self, *args: Any) -> None: ...
    def _get_uid(self, prefix: str = "sv") -> str: ...
    def _change_touch_mode(self, *args: Any) -> None: ...
    def _touch_in_handle(self, pos: Any, size: Any, touch: MotionEvent) -> bool: ...
