"""The one window, and its keyboard."""

from typing import Any, ClassVar

from kivy.event import EventDispatcher
from kivy.graphics import Canvas, RenderContext
from kivy.input.motionevent import MotionEvent
from kivy.properties import (
    BooleanProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    OptionProperty,
    Property,
    StringProperty,
)
from kivy.uix.widget import Widget

class Keyboard(EventDispatcher):
    keycodes: ClassVar[dict[str, int]]
    window: Any
    widget: Any
    target: Any
    callback: Any
    def on_key_down(self, keycode: Any, text: str | None, modifiers: list[str]) -> Any: ...
    def on_key_up(self, keycode: Any) -> Any: ...
    def on_textinput(self, text: str) -> Any: ...
    def release(self) -> None: ...

class WindowBase(EventDispatcher):
    children: ListProperty[Widget]
    parent: ObjectProperty
    modifiers: ListProperty[str]
    width: NumericProperty[int]
    height: NumericProperty[int]
    size: Property[tuple[int, int], tuple[float, float]]
    system_size: Property[tuple[int, int], tuple[float, float]]
    center: Property[tuple[float, float], tuple[float, float]]
    minimum_width: NumericProperty
    minimum_height: NumericProperty
    rotation: NumericProperty
    softinput_mode: OptionProperty
    keyboard_height: NumericProperty
    borderless: BooleanProperty
    fullscreen: OptionProperty[Any]
    mouse_pos: ObjectProperty[tuple[float, float]]
    show_cursor: BooleanProperty
    focus: BooleanProperty
    top: NumericProperty[int]
    left: NumericProperty[int]
    title: StringProperty
    dpi: NumericProperty
    clearcolor: Property[Any, Any]
    allow_screensaver: BooleanProperty
    render_context: ObjectProperty[RenderContext]
    canvas: ObjectProperty[Canvas]
    def add_widget(self, widget: Widget, canvas: str | None = None) -> None: ...
    def remove_widget(self, widget: Widget) -> None: ...
    def mainloop(self) -> None: ...
    def close(self) -> None: ...
    def clear(self) -> None: ...
    def flip(self) -> None: ...
    def show(self) -> None: ...
    def hide(self) -> None: ...
    def minimize(self) -> None: ...
    def maximize(self) -> None: ...
    def restore(self) -> None: ...
    def raise_window(self) -> None: ...
    def screenshot(self, name: str = ...) -> str | None: ...
    def request_keyboard(
        self, callback: Any, target: Any, input_type: str = "text", keyboard_suggestions: bool = True
    ) -> Any: ...
    def release_keyboard(self, target: Any = None) -> None: ...
    def release_all_keyboards(self) -> None: ...
    def update_viewport(self) -> None: ...
    def transform_motion_event_2d(self, me: MotionEvent, widget: Any = None) -> None: ...

Window: WindowBase
