"""Maps made of tiles."""

from typing import Any

from kivy.properties import ListProperty, NumericProperty, ObjectProperty
from kivy.uix.widget import Widget

class MapView(Widget):
    lon: NumericProperty
    lat: NumericProperty
    zoom: NumericProperty[int]
    map_source: ObjectProperty
    background_color: ListProperty[float]
    animation_duration: NumericProperty
    delta_x: NumericProperty
    delta_y: NumericProperty
    _zoom: int
    _scale: float
    _scatter: Any
    _transform_lock: bool
    _invalid_scale: bool
    def unload(self) -> None: ...
    def center_on(self, lat: float, lon: float) -> None: ...
    def _animate_color(self, dt: float) -> Any: ...
