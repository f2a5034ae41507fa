"""A scroll that stops at its ends."""

from typing import Any

from kivy.event import EventDispatcher
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty

class ScrollEffect(EventDispatcher):
    drag_threshold: NumericProperty
    velocity: NumericProperty
    friction: NumericProperty
    value: NumericProperty
    is_manual: BooleanProperty
    min: NumericProperty
    max: NumericProperty
    scroll: NumericProperty
    overscroll: NumericProperty
    displacement: NumericProperty
    target_widget: ObjectProperty
    def reset(self, pos: float) -> None: ...
    def start(self, val: float, t: float | None = None) -> None: ...
    def update(self, val: float, t: float | None = None) -> None: ...
    def stop(self, val: float, t: float | None = None) -> None: ...
    def cancel(self) -> None: ...
    def update_velocity(self, dt: float) -> None: ...
    def on_value(self, *args: Any) -> None: ...
