"""A long list that has widgets only for what is seen of it."""

from collections.abc import Sequence
from typing import Any

from kivy.properties import Property
from kivy.uix.scrollview import ScrollView

class RecycleView(ScrollView):
    data: Property[list[dict[str, Any]], Sequence[dict[str, Any]]]
    data_model: Property[Any, Any]
    view_adapter: Property[Any, Any]
    layout_manager: Property[Any, Any]
    viewclass: Property[Any, Any]
    key_viewclass: Property[Any, Any]
    def refresh_views(self, *args: Any) -> None: ...
    def refresh_from_data(self, *args: Any, **kwargs: Any) -> None: ...
    def refresh_from_layout(self, *args: Any, **kwargs: Any) -> None: ...
    def refresh_from_viewport(self, *args: Any) -> None: ...
