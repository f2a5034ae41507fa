"""A field to type into."""

from typing import Any

from kivy.properties import (
    BooleanProperty,
    ColorProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    OptionProperty,
    Property,
    StringProperty,
    VariableListProperty,
)
from kivy.uix.behaviors import FocusBehavior
from kivy.uix.widget import Widget

class TextInput(FocusBehavior, Widget):
    text: StringProperty
    hint_text: StringProperty
    hint_text_color: ColorProperty
    readonly: BooleanProperty
    multiline: BooleanProperty
    do_wrap: BooleanProperty
    password: BooleanProperty
    text_validate_unfocus: BooleanProperty
    cursor: Property[tuple[int, int], tuple[int, int]]
    cursor_pos: Property[tuple[float, float], Any]
    cursor_color: ColorProperty
    cursor_width: NumericProperty
    cursor_blink: BooleanProperty
    line_height: NumericProperty
    line_spacing: NumericProperty
    padding: VariableListProperty
    halign: OptionProperty
    scroll_x: NumericProperty
    scroll_y: NumericProperty
    selection_color: ColorProperty
    selection_text: StringProperty
    selection_from: Property[int | None, Any]
    selection_to: Property[int | None, Any]
    border: ListProperty[float]
    background_normal: StringProperty
    background_active: StringProperty
    background_color: ColorProperty
    foreground_color: ColorProperty
    disabled_foreground_color: ColorProperty
    use_bubble: BooleanProperty
    use_handles: BooleanProperty
    font_name: StringProperty
    font_size: NumericProperty
    minimum_height: NumericProperty
    input_filter: ObjectProperty
    write_tab: BooleanProperty
    def on_text_validate(self) -> Any: ...
    def insert_text(self, substring: str, from_undo: bool = False) -> Any: ...
    def do_backspace(self, from_undo: bool = False, mode: str = "bkspc") -> Any: ...
    def select_all(self) -> None: ...
    def select_text(self, start: int, end: int) -> None: ...
    def cancel_selection(self) -> None: ...
    def delete_selection(self, from_undo: bool = False) -> None: ...
    def do_cursor_movement(self, action: str, control: bool = False, alt: bool = False) -> None: ...
    def get_cursor_from_index(self, index: int) -> tuple[int, int]: ...
    def cursor_index(self, cursor: tuple[int, int] | None = None) -> int: ...
