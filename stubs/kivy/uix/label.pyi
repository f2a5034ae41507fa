"""Text."""

from typing import Any

from kivy.core.text import LabelBase
from kivy.graphics.texture import Texture
from kivy.properties import (
    BooleanProperty,
    ColorProperty,
    DictProperty,
    ListProperty,
    NumericProperty,
    ObjectProperty,
    OptionProperty,
    StringProperty,
    VariableListProperty,
)
from kivy.uix.widget import Widget

class Label(Widget):
    text: StringProperty
    text_size: ListProperty[float | None]
    font_name: StringProperty
    font_size: NumericProperty
    line_height: NumericProperty
    bold: BooleanProperty
    italic: BooleanProperty
    padding: VariableListProperty
    halign: OptionProperty
    valign: OptionProperty
    color: ColorProperty
    disabled_color: ColorProperty
    outline_width: NumericProperty
    outline_color: ColorProperty
    texture: ObjectProperty[Texture | None]
    texture_size: ListProperty[float]
    mipmap: BooleanProperty
    shorten: BooleanProperty
    shorten_from: OptionProperty
    is_shortened: BooleanProperty
    split_str: StringProperty
    markup: BooleanProperty
    refs: DictProperty
    anchors: DictProperty
    max_lines: NumericProperty[int]
    strip: BooleanProperty
    _label: LabelBase
    def texture_update(self, *args: Any) -> None: ...
    def on_ref_press(self, ref: str) -> Any: ...
